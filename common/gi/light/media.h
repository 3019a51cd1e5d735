// media.h: the solid transmitting materials that a path is inside of, so that nested dielectrics (a
// glass ball in water) meet with the right relative index of refraction. Around all is air (1).
//
// Where two solids overlap, the higher rank counts (solid_ranks.h), whatever came first on the
// path. The surface of the other is passed straight on, as one more step of a specular chain. Where
// two touch, both are crossed at once (tracing/contacts.h).
//
// Fails:   leaving what was never entered changes nothing: a light inside two nested solids is taken
//          for one in the inner alone. Beyond kMaxNested solids the lowest ranks are forgotten.
// Threads: plain value.
#pragma once

namespace ninefold {

class MediumStack {
 public:
  static constexpr int kMaxNested = 4;
  static constexpr int kAir = -1;

  // Material index of the medium that counts, or kAir.
  int innermost() const { return count_ == 0 ? kAir : solids_[count_ - 1].material; }

  bool contains(int material) const {
    for (int i = 0; i < count_; ++i)
      if (solids_[i].material == material) return true;
    return false;
  }
  void enter(int material, int rank) {
    if (count_ == kMaxNested) {
      if (rank <= solids_[0].rank) return;
      removeAt(0);
    }
    int at = count_++;
    for (; at > 0 && solids_[at - 1].rank > rank; --at) solids_[at] = solids_[at - 1];
    solids_[at] = {material, rank};
  }
  void leave(int material) {
    for (int i = 0; i < count_; ++i)
      if (solids_[i].material == material) return removeAt(i);
  }

 private:
  struct Solid {
    int material, rank;
  };
  void removeAt(int at) {
    for (int i = at + 1; i < count_; ++i) solids_[i - 1] = solids_[i];
    --count_;
  }
  Solid solids_[kMaxNested] = {};  // by rising rank
  int count_ = 0;
};

}  // namespace ninefold
