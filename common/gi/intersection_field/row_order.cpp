#include "common/gi/intersection_field/row_order.h"

#include <algorithm>
#include <tuple>

namespace ninefold {

uint32_t RowOrder::rowAt(const StatePages& pages, uint32_t rank) const {
  const std::lock_guard lock(mutex_);
  if (order_.empty() || key_ != pages.hash()) order_ = orderOf(pages), key_ = pages.hash();
  return order_[rank % order_.size()];
}

std::vector<uint32_t> RowOrder::orderOf(const StatePages& pages) const {
  struct Age {
    bool isPresent;
    uint32_t version, row;
  };
  std::vector<Age> ages;
  for (uint32_t row = 0; row < rows_.count(); ++row) {
    const auto header = rows_.header(pages, row);
    ages.push_back({header && header->stamp == stamp_, header ? header->version : 0, row});
  }
  std::ranges::sort(ages, {},
                    [](const Age& age) { return std::tuple(age.isPresent, age.version, age.row); });
  std::vector<uint32_t> order;
  for (const Age& age : ages) order.push_back(age.row);
  return order;
}

}  // namespace ninefold
