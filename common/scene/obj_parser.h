// obj_parser.h: the statements of a Wavefront OBJ file, checked, one after another.
//
// Checked: numbers of v, vn, vt are finite; corners of faces name vertices that exist (counted
// from the end if negative); polygons have 3 to kMaxCorners corners; the triangles stay within
// reader.h's limit. Positions are in double precision: a scene in map coordinates (half a million
// metres and some) would stand on a grid of 3 cm in single.
//
// v x y z        a position; a fourth number is the weight of a rational curve, which no face has
// v x y z r g b  and its colour, as a screen shows it (sRGB), which is how Blender and MeshLab
//                write and read it; a seventh number, its opacity, is left out
// vt u           is on the line v = 0
//
// One warning names what nobody reads (lines, points, curves, ...).
// Source:  Wavefront's Advanced Visualizer manual, appendix B1.
// Threads: pure, but for the log.   Errors: throws Error, naming the line.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "common/math/vec.h"

namespace ninefold {

inline constexpr size_t kMaxCorners = 1024;

// Places in the lists of positions, texture coordinates and normals so far; -1 = absent.
struct ObjCorner {
  int position = -1, coordinate = -1, normal = -1;
  bool operator==(const ObjCorner&) const = default;
};

class ObjEvents {
 public:
  virtual ~ObjEvents() = default;
  virtual void addLibraries(std::string_view line) = 0;  // what follows mtllib
  virtual void addPosition(DVec3 position) = 0;
  virtual void colourPosition(Vec3 srgb) = 0;       // the last one
  virtual void addCoordinate(Vec2 coordinate) = 0;  // v grows upwards
  virtual void addNormal(Vec3 normal) = 0;
  virtual void addFace(std::span<const ObjCorner> corners) = 0;
  virtual void startGroup(std::string name) = 0;
  virtual void useMaterial(std::string name) = 0;
};

void parseObj(std::string_view text, ObjEvents& events);

}  // namespace ninefold
