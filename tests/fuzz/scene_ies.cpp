// scene_ies.cpp: any bytes as a photometric file: an Error, or a profile that passes its checks,
// can be sampled and is read again as it was written.
#include <cstdlib>
#include <string>
#include <string_view>

#include "common/base/error.h"
#include "common/scene/ies_file.h"
#include "common/scene/profile_sampling.h"
#include "tests/fuzz/fuzz.h"

namespace {

void expect(bool holds) {
  if (!holds) std::abort();
}

void lookAt(const ninefold::IesFile& file) {
  using namespace ninefold;
  const LightProfile& p = file.profile;
  checkProfile(p, "profile");
  checkProfile(mirrored(p), "mirror image");
  const ProfileSampling sampling(p);
  expect(sampling.solidAngle() >= 0 && file.peak >= 0);
  const Vec3 axis(0, 0, -1), across(1, 0, 0);
  for (int i = 0; i < 16 && sampling.solidAngle() > 0; ++i) {
    const Vec2 u(static_cast<float>(i) / 16, static_cast<float>(i * 7 % 16) / 16);
    const Vec3 w = sampling.sample(axis, across, u);
    expect(isFinite(w) && std::abs(glm::length(w) - 1) < 1e-5f);
    const float pdf = sampling.pdf(axis, across, w);
    expect(pdf >= 0);
  }
  if (p.values.size() > 100'000) return;  // slow to write, and no different
  const LightProfile again = readIes(iesText(p)).profile;
  expect(again.vertical == p.vertical && again.horizontal == p.horizontal);
}

}  // namespace

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  const std::string_view seeds[] = {
      "IESNA:LM-63-2002\n[TEST] x\n[MANUFAC] y\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 60\n"
      "0 45 90\n0\n100 80 0\n",
      "IESNA91\nTILT=INCLUDE\n1\n3\n0 45 90\n1.0 .9 .8\n2 -1 1.5 2 3 1 1 .5 .5 0\n0.9 0.95 100\n"
      "90 180\n0 45 90\n10 20 30 40 5e1 60\n",
      "a lamp of 1986\nTILT=lamp.tlt\n1,1000,1,3,5,1,2,0,0,0\r\n1,1,60\r\n0,90,180\r\n"
      "0,90,180,270,360\r\n1,2,3,4,5,6,7,8,9,10,11,12,1,2,3\r\n\x1A",
      "IESNA:LM-63-1995\nTILT=NONE\n1 -1 1 2 3 1 2 0 0 0\n1 1 0\n0 90\n90 200 270\n1 2 3 4 5 6\n",
      "IES:LM-63-2019\nTILT=NONE\n1 -1 1 2 2 2 2 0 0 0\n1 1.1 0\n-90 90\n-90 90\n1 2 3 4\n"};
  std::vector<std::vector<uint8_t>> all;
  for (const std::string_view seed : seeds) all.emplace_back(seed.begin(), seed.end());
  return all;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    lookAt(ninefold::readIes({reinterpret_cast<const char*>(data), size}));
  } catch (const ninefold::Error&) {
  }
  return 0;
}
