// media.h: which solid transmitting materials a path is inside of, innermost last, so that nested
// dielectrics (a glass ball in water) meet with the right relative index of refraction. Where two
// overlap, the one entered last counts, and leaving the other one there changes nothing; where two
// touch, both are crossed at once (tracing/contacts.h).
//
// Air (index 1) is around everything. Entering pushes a material, leaving removes its innermost
// entry; leaving what was never entered (a light inside glass) changes nothing, so a light inside two
// nested solids is taken for one in the inner solid alone. Deeper nests than kMaxNested forget the
// outermost entry. Threads: plain value.
#pragma once

namespace ninefold {

class MediumStack {
 public:
  static constexpr int kMaxNested = 4;
  static constexpr int kAir = -1;

  // Material index of the innermost medium, or kAir.
  int innermost() const { return count_ == 0 ? kAir : material_[count_ - 1]; }

  bool contains(int material) const {
    for (int i = 0; i < count_; ++i)
      if (material_[i] == material) return true;
    return false;
  }
  void enter(int material) {
    if (count_ == kMaxNested) {
      for (int i = 1; i < kMaxNested; ++i) material_[i - 1] = material_[i];
      --count_;
    }
    material_[count_++] = material;
  }
  void leave(int material) {
    for (int i = count_ - 1; i >= 0; --i) {
      if (material_[i] != material) continue;
      for (int j = i + 1; j < count_; ++j) material_[j - 1] = material_[j];
      --count_;
      return;
    }
  }

 private:
  int material_[kMaxNested] = {};
  int count_ = 0;
};

}  // namespace ninefold
