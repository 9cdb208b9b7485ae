#pragma once
// What OBJ calls faces by, beside the object they belong to.

#include <array>
#include <cstddef>

namespace subdivd::proto::text {

enum LabelKind : std::size_t { kGroup, kMaterial, kLabelKinds };  // `g`, `usemtl`

// The uniform primvars that hold the numbers of their names.
inline constexpr std::array<const char*, kLabelKinds> kLabelPrimvars = {"group", "material"};

}  // namespace subdivd::proto::text
