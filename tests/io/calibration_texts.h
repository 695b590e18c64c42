// tests/io/calibration_texts.h: one rig, written in every form that softscope reads.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace softscope::test {

// The rig of all texts: f 500 and 502 x 505 px, 640 x 480, baseline 5 mm, the right camera turned
// by 0.01 rad about y: its rotation's cosine and sine.
inline constexpr const char* kRotation =
    "0.99995000041666528 0 -0.0099998333341666645 0 1 0 0.0099998333341666645 0 "
    "0.99995000041666528";

inline std::string commas(std::string text) {
  for (char& c : text)
    if (c == ' ') c = ',';
  return text;
}

inline std::string yamlMatrix(const std::string& name, int rows, int columns,
                              const std::string& numbers) {
  return name + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
         "\n   cols: " + std::to_string(columns) + "\n   dt: d\n   data: [ " + commas(numbers) +
         " ]\n";
}

/// `head`: text before the matrices; `translation`: T.
inline std::string openCvYaml(const std::string& head = "image_width: 640\nimage_height: 480\n",
                              const std::string& translation = "-5 0.02 0.03") {
  return "%YAML:1.0\n---\n" + head + yamlMatrix("M1", 3, 3, "500 0 321 0 500 241 0 0 1") +
         yamlMatrix("D1", 1, 5, "-0.1 0.02 0.001 -0.002 0.003") +
         yamlMatrix("M2", 3, 3, "502 0 318 0 505 239 0 0 1") +
         yamlMatrix("D2", 1, 5, "-0.11 0.03 0.002 -0.001 0.004") +
         yamlMatrix("R", 3, 3, kRotation) + yamlMatrix("T", 3, 1, translation);
}

inline std::string xmlMatrix(const std::string& name, int rows, int columns,
                             const std::string& numbers) {
  return "<" + name + " type_id=\"opencv-matrix\">\n  <rows>" + std::to_string(rows) +
         "</rows>\n  <cols>" + std::to_string(columns) + "</cols>\n  <dt>d</dt>\n  <data>\n    " +
         numbers + "</data></" + name + ">\n";
}

inline std::string openCvXml() {
  return "<?xml version=\"1.0\"?>\n<!-- made by a test -->\n<opencv_storage>\n"
         "<image_width>640</image_width>\n<image_height>480</image_height>\n" +
         xmlMatrix("M1", 3, 3, "500. 0. 321. 0. 500. 241. 0. 0. 1.") +
         xmlMatrix("D1", 1, 5, "-0.1 0.02 0.001 -0.002 0.003") +
         xmlMatrix("M2", 3, 3, "502. 0. 318. 0. 505. 239. 0. 0. 1.") +
         xmlMatrix("D2", 1, 5, "-0.11 0.03 0.002 -0.001 0.004") + xmlMatrix("R", 3, 3, kRotation) +
         xmlMatrix("T", 3, 1, "-5. 0.02 0.03") + "</opencv_storage>\n";
}

inline std::string scaredJson() {
  return R"({"camera-calibration": {
    "DL": [[-0.1, 0.02, 0.001, -0.002, 0.003]], "DR": [[-0.11, 0.03, 0.002, -0.001, 0.004]],
    "KL": [[500, 0, 321], [0, 500, 241], [0, 0, 1]], "KR": [[502, 0, 318], [0, 505, 239], [0, 0, 1]],
    "R": [[0.99995000041666528, 0, -0.0099998333341666645], [0, 1, 0],
          [0.0099998333341666645, 0, 0.99995000041666528]],
    "T": [[-5], [0.02], [0.03]]},
  "camera-pose": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], "timestamp": 1})";
}

inline std::string openCas() {
  return "RAT\n2\n\n 640 480 500 0 321 0 500 241 0 0 1  -0.1 0.02 0.001 -0.002 0.003 0.4 0.5 0.6"
         "  1 0 0 0 1 0 0 0 1  0 0 0\n\n 640 480 502 0 318 0 505 239 0 0 1"
         "  -0.11 0.03 0.002 -0.001 0.004 0.7 0.8 0.9  " +
         std::string(kRotation) + "  -5 0.02 0.03\n\n 0 0 0 0 0 0 0 0\n";
}

inline const std::string kHamlynLeft = "500 0 321\n0 500 241\n0 0 1\n-0.1 0.02 0.001 -0.002\n";
inline const std::string kHamlynRight = "502 0 318\n0 505 239\n0 0 1\n-0.11 0.03 0.002 -0.001\n";
inline const std::string kHamlynPose =
    "0.99995000041666528 0 -0.0099998333341666645\n0 1 0\n"
    "0.0099998333341666645 0 0.99995000041666528\n-5 0.02 0.03\n";

/// `shift`: P(0,3), which is -fx * baseline in metres.
inline std::string rosYaml(const std::string& matrix, const std::string& lens,
                           const std::string& rectification, const std::string& shift) {
  const auto block = [](const std::string& name, int rows, int columns, const std::string& data) {
    return name + ":\n  rows: " + std::to_string(rows) + "\n  cols: " + std::to_string(columns) +
           "\n  data: [" + commas(data) + "]\n";
  };
  return "image_width: 640\nimage_height: 480\ncamera_name: scope\n" +
         block("camera_matrix", 3, 3, matrix) + "distortion_model: plumb_bob\n" +
         block("distortion_coefficients", 1, 5, lens) +
         block("rectification_matrix", 3, 3, rectification) +
         block("projection_matrix", 3, 4, "510 0 320 " + shift + " 0 510 240 0 0 0 1 0");
}

/// poses_bounds.npy with `rows` rows of a 640 x 480 camera of focal length 500.
inline std::string endoNerfNpy(int rows = 3, double focal_px = 500) {
  std::string header =
      "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", 17), }";
  while ((10 + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string out = std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size() & 255) +
                    static_cast<char>(header.size() >> 8) + header;
  for (int row = 0; row < rows; ++row) {
    const std::vector<double> values = {1,   0, 0, 0, 480, 0,        1,  0, 0,
                                        640, 0, 0, 1, 0,   focal_px, 20, 90};
    for (const double value : values) {
      char raw[8];
      std::memcpy(raw, &value, 8);
      out.append(raw, 8);
    }
  }
  return out;
}

}  // namespace softscope::test
