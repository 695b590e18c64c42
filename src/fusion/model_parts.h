// src/fusion/model_parts.h: parts of a point model that change together.
#pragma once

namespace softscope {

/// Any of the four, joined by |.
using ModelParts = unsigned;
constexpr ModelParts kModelShape = 1;     // positions and normals
constexpr ModelParts kModelLooks = 2;     // colours, anchors, weights
constexpr ModelParts kModelBindings = 4;  // to nodes of the graph
constexpr ModelParts kModelMemory = 8;    // InsertionMemory
constexpr ModelParts kModelPoints = kModelShape | kModelLooks | kModelBindings;
constexpr ModelParts kWholeModel = kModelPoints | kModelMemory;

}  // namespace softscope
