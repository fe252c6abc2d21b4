// What files of the scene formats say of themselves, and what assimp 5.2 would make of it.
#pragma once

#include <string>

#include "meshes/assimp_input.h"

namespace vex {

/// Each looks at `input->bytes`, sets the unit that the file states, and refuses (InputError) what assimp would read as
/// another body than the file holds.
///
/// COLLADA: the unit is metres unless <unit meter="..."> says another; assimp scales by it, so it is shown 1. Numbers
/// must be decimal numbers: assimp takes 1,5 and 1.0D+01 for others than they are.
void look_into_collada(AssimpInput* input);
/// 3MF: the model's unit, millimetres by default. A model in several parts, or that requires an extension which holds
/// geometry, is refused, and so are vertices, triangles and transforms without all their numbers. Preview pictures are
/// hidden: assimp deletes them twice.
void look_into_3mf(AssimpInput* input);
/// glTF: metres, by its specification. Refused: versions but 2, and required extensions that assimp does not heed.
void look_into_gltf(AssimpInput* input);
/// AMF: its unit, millimetres by default.
void look_into_amf(AssimpInput* input);

}  // namespace vex
