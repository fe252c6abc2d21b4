// What files of the scene formats say of themselves, and what assimp 5.2 would make of it.
#pragma once

#include <string>

#include "meshes/assimp_input.h"

namespace vex {

/// Each looks at `input->bytes`, sets the unit that the file states, and refuses (InputError) what assimp would read as
/// another body than the file holds.
///
/// COLLADA: the unit is metres unless a unit element with an attribute meter says another; assimp scales by it, so it
/// is shown 1. Numbers must be decimal numbers, of fewer than 19 digits before the point, and indices whole numbers:
/// assimp takes 1,5 and 1.0D+01 for others than they are, and what is longer for 0. A node that is skewed is refused,
/// or shows what is not in the file: assimp leaves that out. So are transforms of too many numbers, and two geometries
/// of one id.
void look_into_collada(AssimpInput* input);
/// 3MF: the model's unit, millimetres by default. A model in several parts, or that requires an extension which holds
/// geometry, is refused, and so are vertices, triangles and transforms without all their numbers, items and components
/// of an object that is not there, and two objects of one number. Preview pictures are hidden: assimp deletes them
/// twice.
void look_into_3mf(AssimpInput* input);
/// glTF: metres, by its specification. Refused: versions but 2, required extensions that assimp does not heed, and what
/// gltf_summary finds unread or misread.
void look_into_gltf(AssimpInput* input);
/// AMF: its unit, millimetres by default. Refused: coordinates and triangles without all their numbers, a mesh in
/// several volumes, of which assimp reads one, turned, scaled and mirrored instances, curved triangles, and two objects
/// of one name.
void look_into_amf(AssimpInput* input);
/// X3D as XML: what is curved or passed over is refused, and in attributes that hold geometry words that are no decimal
/// numbers.
void look_into_x3d(AssimpInput* input);
/// NFF: balls, cones and cylinders are refused.
void look_into_nff(AssimpInput* input);
/// IFC: what is curved is refused.
void look_into_ifc(AssimpInput* input);

}  // namespace vex
