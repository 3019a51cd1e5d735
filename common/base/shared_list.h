// shared_list.h: a std::vector whose copies share their elements until one of them is changed.
// Copying costs nothing. References into a const list stay valid while any copy lives.
//
// Threads: copies may be read at once; whoever changes one must be its only user.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace ninefold {

template <typename T>
class SharedList {
 public:
  SharedList() : list_(std::make_shared<std::vector<T>>()) {}
  SharedList(std::vector<T> list) : list_(std::make_shared<std::vector<T>>(std::move(list))) {}
  SharedList(std::initializer_list<T> list) : SharedList(std::vector<T>(list)) {}

  operator const std::vector<T>&() const { return *list_; }
  size_t size() const { return list_->size(); }
  bool empty() const { return list_->empty(); }
  const T& operator[](size_t i) const { return (*list_)[i]; }
  auto begin() const { return list_->cbegin(); }
  auto end() const { return list_->cend(); }

  // For changes: gives this list elements of its own first.
  std::vector<T>& own() {
    if (list_.use_count() > 1) list_ = std::make_shared<std::vector<T>>(*list_);
    return *list_;
  }
  T& operator[](size_t i) { return own()[i]; }
  auto begin() { return own().begin(); }
  auto end() { return own().end(); }
  void push_back(T value) { own().push_back(std::move(value)); }
  void resize(size_t n) { own().resize(n); }

 private:
  std::shared_ptr<std::vector<T>> list_;  // never null
};

}  // namespace ninefold
