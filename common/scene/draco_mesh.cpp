#include "common/scene/draco_mesh.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <concepts>
#include <string>

#include "common/base/error.h"

namespace ninefold {
namespace {

constexpr uint64_t kBytesOfValue = 8;  // before and after it is dequantized

// What a stream says of its size before its connectivity follows.
struct Claim {
  uint32_t faces = 0, points = 0;
  uint8_t seams = 0;
};

template <typename Decoder>
bool readClaim(draco::DecoderBuffer ahead, Claim& claim) {
  if constexpr (std::same_as<Decoder, draco::MeshEdgebreakerDecoder>)
    return draco::DecodeVarint(&claim.points, &ahead) &&
           draco::DecodeVarint(&claim.faces, &ahead) && ahead.Decode(&claim.seams);
  else
    return draco::DecodeVarint(&claim.faces, &ahead) && draco::DecodeVarint(&claim.points, &ahead);
}

// A decoder of Draco's that stops where a claim is too large. It only takes note of it: Draco is
// not made for exceptions that pass through.
template <typename Decoder>
class Bounded : public Decoder {
 public:
  Bounded(size_t streamBytes, const DracoBudget& budget)
      : streamBytes_(streamBytes), budget_(&budget) {}
  const std::string& complaint() const { return complaint_; }

 protected:
  bool DecodeConnectivity() override {
    Claim claim;
    if (!readClaim<Decoder>(*this->buffer(), claim)) return false;
    const uint64_t most = kMostFacesPerByte * streamBytes_;
    if (claim.faces > most || claim.points > 3 * most)
      return complain(fmt::format("{} bytes cannot hold {} triangles of {} vertices: damaged",
                                  streamBytes_, claim.faces, claim.points));
    if (uint64_t{claim.faces} * (1 + uint64_t{claim.seams}) > budget_->faces)
      return complain("the file's compressed meshes are too large: split or simplify the scene");
    return Decoder::DecodeConnectivity();
  }

  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    uint64_t components = 0;
    if (cloud.num_attributes() > kMostDracoAttributes)
      return complain(fmt::format("has {} attributes, more than {}", cloud.num_attributes(),
                                  kMostDracoAttributes));
    for (int i = 0; i < cloud.num_attributes(); ++i) {
      const int own = cloud.attribute(i)->num_components();
      if (own < 1 || own > 4)
        return complain(fmt::format("has an attribute of {} components, more than 4", own));
      components += static_cast<uint64_t>(own);
    }
    if (kBytesOfValue * components * cloud.num_points() > budget_->bytes)
      return complain("the file's compressed meshes are too large: split or simplify the scene");
    return Decoder::DecodeAllAttributes();
  }

 private:
  bool complain(std::string text) {
    complaint_ = std::move(text);
    return false;
  }

  size_t streamBytes_;
  const DracoBudget* budget_;
  std::string complaint_;
};

template <typename Decoder>
std::unique_ptr<draco::Mesh> decode(std::span<const unsigned char> stream,
                                    const DracoBudget& budget) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
  auto mesh = std::make_unique<draco::Mesh>();
  Bounded<Decoder> decoder(stream.size(), budget);
  const draco::Status status = decoder.Decode(draco::DecoderOptions(), &buffer, mesh.get());
  if (!decoder.complaint().empty()) fail("{}", decoder.complaint());
  if (!status.ok()) fail("damaged ({}): export anew", status.error_msg());
  return mesh;
}

draco::DracoHeader headerOf(std::span<const unsigned char> stream) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok())
    fail("is no Draco data: damaged, export anew");
  if (header.version_major != 2 || header.version_minor != 2)
    fail("is Draco data of version {}.{}, only 2.2 is read: export anew", header.version_major,
         header.version_minor);
  if (header.encoder_type != draco::TRIANGULAR_MESH) fail("is not a mesh: damaged, export anew");
  return header;
}

}  // namespace

std::unique_ptr<draco::Mesh> decodeDracoMesh(std::span<const unsigned char> stream,
                                             DracoBudget& budget) {
  const bool isSequential = headerOf(stream).encoder_method == draco::MESH_SEQUENTIAL_ENCODING;
  auto mesh = isSequential ? decode<draco::MeshSequentialDecoder>(stream, budget)
                           : decode<draco::MeshEdgebreakerDecoder>(stream, budget);
  budget.faces -= std::min<uint64_t>(budget.faces, mesh->num_faces());
  for (int i = 0; i < mesh->num_attributes(); ++i)
    budget.bytes -= std::min(budget.bytes, kBytesOfValue * mesh->num_points() *
                                               uint64_t(mesh->attribute(i)->num_components()));
  return mesh;
}

}  // namespace ninefold
