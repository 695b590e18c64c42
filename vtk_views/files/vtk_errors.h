// vtk_views/files/vtk_errors.h: conversion of VTK errors to exceptions.
#pragma once

#include <vtkAlgorithm.h>

#include <string>

namespace softscope {

/// Runs a reader with its pipeline. VTK reports failures as events and still returns data, so
/// the events are collected. Throws InputError with `source` and the first message of VTK, and
/// Error outside of guardedRead(): readers of other libraries crash on some damaged files.
void updateOrThrow(vtkAlgorithm& reader, const std::string& source);

}  // namespace softscope
