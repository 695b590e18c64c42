// tests/vtk_views/dicom_tags.h: damage to one tag of a DICOM file.
#pragma once

#include <filesystem>
#include <vector>

namespace softscope::test {

/// Replaces the text of a tag in a file of explicit VR, little endian, or (null) takes the tag out.
/// Fails the test where there is none.
void replaceDicomTag(const std::filesystem::path& file, unsigned group, unsigned element,
                     const char* value);

/// One file of Enhanced CT: 5 x 4 pixels of 0.5 x 0.6 mm per frame, straight, at these places along
/// z; pixel i of frame f is 20 f + i - 1000.
void writeMultiFrame(const std::filesystem::path& file, const std::vector<double>& places_mm);

}  // namespace softscope::test
