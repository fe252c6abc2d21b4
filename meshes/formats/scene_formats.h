// What files of the scene formats say of themselves, and what assimp 5.2 would make of it.
#pragma once

#include <string>

#include "meshes/assimp_input.h"

namespace vex {

/// Each looks at `input->bytes`, sets the unit that the file states, and refuses (InputError) what assimp would read as
/// another body than the file holds.
///
/// COLLADA: the unit is metres unless a unit element with an attribute meter says another; assimp scales by it, so it is shown 1. Numbers
/// must be decimal numbers, of fewer than 19 digits before the point, and indices whole numbers: assimp takes 1,5 and
/// 1.0D+01 for others than they are, and what is longer for 0. A node that is skewed is refused: assimp leaves that
/// out.
void look_into_collada(AssimpInput* input);
/// 3MF: the model's unit, millimetres by default. A model in several parts, or that requires an extension which holds
/// geometry, is refused, and so are vertices, triangles and transforms without all their numbers, items and components
/// of an object that is not there, and two objects of one number. Preview pictures are hidden: assimp deletes them
/// twice.
void look_into_3mf(AssimpInput* input);
/// glTF: metres, by its specification. Refused: versions but 2, and required extensions that assimp does not heed.
void look_into_gltf(AssimpInput* input);
/// AMF: its unit, millimetres by default. Refused: coordinates and triangles without all their numbers, a mesh in
/// several volumes, of which assimp reads one, turned instances, curved triangles, and two objects of one name.
void look_into_amf(AssimpInput* input);

}  // namespace vex
