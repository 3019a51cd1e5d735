// gltf_unread.h: what a glTF file says that the reader does not read: vertex attributes, material
// properties and extensions. The file's JSON is compared with the table of all that is read, so
// that what nobody has thought of is told, too.
// Threads: pure.   Errors: none; JSON that cannot be parsed is reported elsewhere.
#pragma once

#include <string>
#include <string_view>

namespace ninefold {

// Whether the reader reads this extension, or need not.
bool isReadExtension(std::string_view name);

// One line, without repetition, in alphabetical order: "vertex attributes COLOR_1; material
// properties occlusionTexture (light is computed); extensions VENDOR_magic": what is shown instead
// is said where it is known. Empty if all is read.
// `json`: well-formed and of bounded depth (gltf_guard.h).
std::string unreadOf(std::string_view json);

}  // namespace ninefold
