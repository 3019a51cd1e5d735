// shared_list.h: a list whose copies share their elements, each until one of them changes it.
// Copying costs nothing. References into a const list stay valid while any copy keeps the element.
// An element that two lists share has one address in both, so that it can tell that it is the same.
//
// Threads: copies may be read at once; whoever changes one must be its only user.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace ninefold {

template <typename T>
class SharedList {
 public:
  using Element = std::shared_ptr<const T>;
  template <typename List>
  class Iterator {
   public:
    using difference_type = std::ptrdiff_t;
    using value_type = T;
    Iterator() = default;
    Iterator(List* list, size_t i) : list_(list), i_(i) {}
    auto& operator*() const { return (*list_)[i_]; }
    auto* operator->() const { return &(*list_)[i_]; }
    Iterator& operator++() { return ++i_, *this; }
    Iterator operator++(int) { return {list_, i_++}; }
    bool operator==(const Iterator& other) const { return i_ == other.i_; }
    difference_type operator-(const Iterator& other) const {
      return static_cast<difference_type>(i_) - static_cast<difference_type>(other.i_);
    }

   private:
    List* list_ = nullptr;
    size_t i_ = 0;
  };

  SharedList() : list_(std::make_shared<Elements>()) {}
  SharedList(std::vector<T> list) : SharedList() {
    for (T& element : list) push_back(std::move(element));
  }
  SharedList(std::initializer_list<T> list) : SharedList(std::vector<T>(list)) {}

  size_t size() const { return list_->size(); }
  bool empty() const { return list_->empty(); }
  const T& operator[](size_t i) const { return *(*list_)[i]; }
  const T& back() const { return *list_->back(); }
  auto begin() const { return Iterator<const SharedList>(this, 0); }
  auto end() const { return Iterator<const SharedList>(this, size()); }

  // Keeps an element alive by itself, and puts it into another list.
  const Element& share(size_t i) const { return (*list_)[i]; }
  void set(size_t i, Element element) { own()[i] = std::move(element); }

  // For changes: gives this list an element of its own first.
  T& operator[](size_t i) {
    Element& element = own()[i];
    if (element.use_count() > 1) element = std::make_shared<T>(*element);
    return const_cast<T&>(*element);  // made as a T, and nobody else has it
  }
  auto begin() { return Iterator<SharedList>(this, 0); }
  auto end() { return Iterator<SharedList>(this, size()); }
  void push_back(T value) { own().push_back(std::make_shared<T>(std::move(value))); }
  void resize(size_t n) {
    own().resize(n);
    for (Element& element : own())
      if (element == nullptr) element = std::make_shared<T>();
  }

 private:
  using Elements = std::vector<Element>;
  Elements& own() {
    if (list_.use_count() > 1) list_ = std::make_shared<Elements>(*list_);
    return *list_;
  }

  std::shared_ptr<Elements> list_;  // never null, nor is any element
};

}  // namespace ninefold
