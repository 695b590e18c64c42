// tests/vtk_views/dicom_tags.h: damage to one tag of a DICOM file.
#pragma once

#include <filesystem>

namespace softscope::test {

/// Replaces the text of a tag in a file of explicit VR, little endian, or (null) takes the tag out.
/// Fails the test where there is none.
void replaceDicomTag(const std::filesystem::path& file, unsigned group, unsigned element,
                     const char* value);

}  // namespace softscope::test
