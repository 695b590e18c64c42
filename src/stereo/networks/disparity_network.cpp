// src/stereo/networks/disparity_network.cpp: checks, trial in a child process, forward pass.
#include "stereo/networks/disparity_network.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/guarded_read.h"
#include "core/not_measured.h"
#include "stereo/images/opencv_view.h"
#include "stereo/networks/onnx_model.h"

namespace softscope {
namespace {

constexpr int kMultiplePx = 32;  // free lengths are padded to this: networks halve five times
constexpr int kTrialShiftPx = 8;
// A trial on one core: time for a network that takes a second on all cores of a workstation,
// and the memory of a cost volume of 1280 x 1024 pixels at a quarter of the size.
constexpr GuardAllowance kTrialAllowance{110, std::uintmax_t{6} << 30};

std::string lowerCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool contains(const std::string& text, const std::string& part) {
  return lowerCase(text).find(part) != std::string::npos;
}

std::string listOf(const std::vector<OnnxTensor>& tensors) {
  std::string text;
  for (const OnnxTensor& tensor : tensors) text += (text.empty() ? "" : ", ") + tensor.text();
  return text.empty() ? "none" : text;
}

/// The words of a message of several lines.
std::string oneLine(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  return printable(line, 300);
}

/// Scale and offset of a level for red, green and blue.
struct LevelScale {
  std::array<double, 3> factor, offset;
};

LevelScale scaleOf(NetworkInput input) {
  if (input == NetworkInput::kLevels) return {{1, 1, 1}, {0, 0, 0}};
  LevelScale scale{{1 / 255.0, 1 / 255.0, 1 / 255.0}, {0, 0, 0}};
  if (input == NetworkInput::kUnit) return scale;
  const std::array<double, 3> mean{0.485, 0.456, 0.406}, deviation{0.229, 0.224, 0.225};
  for (std::size_t i = 0; i < 3; ++i) {
    scale.factor[i] /= deviation[i];
    scale.offset[i] = -mean[i] / deviation[i];
  }
  return scale;
}

/// Fit of a pair to the images of the network: scaled down, then padded right and below.
struct Fit {
  int width_px = 0, height_px = 0;      // of the images of the network
  int used_width = 0, used_height = 0;  // of the pair within them
};

/// Smooth noise, deterministic.
ColourImage trialImage(int width_px, int height_px) {
  cv::Mat noise(height_px, width_px, CV_8UC3);
  cv::RNG random(1);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(noise, noise, {0, 0}, 1.5);
  cv::normalize(noise, noise, 0, 255, cv::NORM_MINMAX);
  ColourImage image(width_px, height_px);
  noise.copyTo(opencvView(image));
  return image;
}

ColourImage columnsOf(const ColourImage& image, int first, int width_px) {
  ColourImage part(width_px, image.height_px);
  opencvView(image).colRange(first, first + width_px).copyTo(opencvView(part));
  return part;
}

std::string sizeText(int width_px, int height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px);
}

}  // namespace

struct DisparityNetwork::Impl {
  Impl(const std::string& path, NetworkInput scale) : file(path), level_scale(scaleOf(scale)) {}

  void read();
  void requireInputs();
  void requireOutput();
  Fit fitOf(int width_px, int height_px) const;
  cv::dnn::Net load(const Fit& fit) const;
  cv::Mat blobOf(const ColourImage& image, const Fit& fit) const;
  Raster<float> run(cv::dnn::Net& net, const Fit& fit, const ColourImage& left,
                    const ColourImage& right) const;
  std::string outputShapeText(const cv::Mat& output, const Fit& fit) const;
  void runTrialPair(int width_px, int height_px, int disparity_max_px) const;
  std::string lackingOperators() const;
  [[noreturn]] void failImport(const cv::Exception& problem, const Fit& fit) const;

  std::string file, bytes;
  LevelScale level_scale;
  OnnxModel model;
  int channels = 3;
  std::int64_t fixed_width = OnnxTensor::kFree, fixed_height = OnnxTensor::kFree;
  std::string left_input, right_input, output;
  std::map<std::pair<int, int>, cv::dnn::Net> nets;  // by size of the images of the network
};

void DisparityNetwork::Impl::read() {
  requireRegularFile(file);
  std::ifstream stream(file, std::ios::binary);
  bytes.assign(std::istreambuf_iterator<char>(stream), {});
  if (!stream.good() && !stream.eof()) throw InputError(file + ": can't be read");
  model = parseOnnx(bytes, file);
  if (model.has_external_weights)
    throw InputError(file +
                     ": keeps its weights in other files, but one file is expected. Export it with "
                     "the weights inside (onnx.save without save_as_external_data)");
  requireInputs();
  requireOutput();
}

void DisparityNetwork::Impl::requireInputs() {
  const auto fail = [&](const std::string& expected) {
    throw InputError(file + ": its inputs are " + listOf(model.inputs) + ", but " + expected +
                     ". Export it so");
  };
  const auto& inputs = model.inputs;
  if (inputs.size() != 2) fail("two are expected, the left and the right image");
  for (const OnnxTensor& input : inputs) {
    if (input.element_type != OnnxTensor::kFloat32 || input.shape.size() != 4)
      fail("images of 1 x 3 x height x width float32 are expected");
    if (input.shape[0] > 1) fail("a batch of 1 is expected");
    if (input.shape[1] != 1 && input.shape[1] != 3) fail("1 or 3 channels are expected");
    for (const std::size_t side : {2, 3})
      if (input.shape[side] > 8192) fail("images of at most 8192 pixels a side are expected");
  }
  if (inputs[0].shape != inputs[1].shape) fail("two of one shape are expected");
  channels = static_cast<int>(inputs[0].shape[1]);
  fixed_height = inputs[0].shape[2];
  fixed_width = inputs[0].shape[3];
  const bool swapped = contains(inputs[0].name, "right") && contains(inputs[1].name, "left");
  left_input = inputs[swapped ? 1 : 0].name;
  right_input = inputs[swapped ? 0 : 1].name;
}

void DisparityNetwork::Impl::requireOutput() {
  std::vector<OnnxTensor> named;
  for (const OnnxTensor& tensor : model.outputs)
    if (model.outputs.size() == 1 || contains(tensor.name, "disp")) named.push_back(tensor);
  if (named.size() != 1)
    throw InputError(file + ": its outputs are " + listOf(model.outputs) +
                     ", but one is expected, or one with `disp` in its name. Export the disparity "
                     "alone");
  output = named[0].name;
}

Fit DisparityNetwork::Impl::fitOf(int width_px, int height_px) const {
  const auto padded = [](int length) {
    return (length + kMultiplePx - 1) / kMultiplePx * kMultiplePx;
  };
  const bool free_width = fixed_width == OnnxTensor::kFree;
  const bool free_height = fixed_height == OnnxTensor::kFree;
  double scale = 1;
  if (!free_width) scale = std::min(scale, static_cast<double>(fixed_width) / width_px);
  if (!free_height) scale = std::min(scale, static_cast<double>(fixed_height) / height_px);
  Fit fit;
  fit.used_width = std::max(1, static_cast<int>(std::lround(scale * width_px)));
  fit.used_height = std::max(1, static_cast<int>(std::lround(scale * height_px)));
  fit.width_px = free_width ? padded(fit.used_width) : static_cast<int>(fixed_width);
  fit.height_px = free_height ? padded(fit.used_height) : static_cast<int>(fixed_height);
  return fit;
}

/// With the size declared, so that operators that compute shapes become constants.
cv::dnn::Net DisparityNetwork::Impl::load(const Fit& fit) const {
  const std::string sized = withInputShape(bytes, file, {1, channels, fit.height_px, fit.width_px});
  cv::dnn::Net net = cv::dnn::readNetFromONNX(sized.data(), sized.size());
  net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
  net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
  return net;
}

cv::Mat DisparityNetwork::Impl::blobOf(const ColourImage& image, const Fit& fit) const {
  cv::Mat scaled = opencvView(image);
  if (fit.used_width != image.width_px || fit.used_height != image.height_px)
    cv::resize(scaled, scaled, {fit.used_width, fit.used_height}, 0, 0, cv::INTER_AREA);
  if (channels == 1) cv::cvtColor(scaled, scaled, cv::COLOR_RGB2GRAY);
  cv::copyMakeBorder(scaled, scaled, 0, fit.height_px - fit.used_height, 0,
                     fit.width_px - fit.used_width, cv::BORDER_REPLICATE);
  std::vector<cv::Mat> planes;
  cv::split(scaled, planes);
  cv::Mat blob(std::vector<int>{1, channels, fit.height_px, fit.width_px}, CV_32F);
  for (int channel = 0; channel < channels; ++channel) {
    cv::Mat plane(fit.height_px, fit.width_px, CV_32F, blob.ptr<float>(0, channel));
    const auto c = static_cast<std::size_t>(channel);
    planes[c].convertTo(plane, CV_32F, level_scale.factor[c], level_scale.offset[c]);
  }
  return blob;
}

std::string DisparityNetwork::Impl::outputShapeText(const cv::Mat& found, const Fit& fit) const {
  std::string shape;
  for (int i = 0; i < found.dims; ++i)
    shape += (i == 0 ? "" : " x ") + std::to_string(found.size[i]);
  return file + ": its output " + printable(output) + " is " + shape + ", but 1 x 1 x " +
         sizeText(fit.height_px, fit.width_px) +
         ", a disparity in pixels for each pixel of its left image, is expected. Export the "
         "disparity at the size of the images";
}

/// Disparity in pixels of the original pair, with positive sign.
Raster<float> DisparityNetwork::Impl::run(cv::dnn::Net& net, const Fit& fit,
                                          const ColourImage& left, const ColourImage& right) const {
  net.setInput(blobOf(left, fit), left_input);
  net.setInput(blobOf(right, fit), right_input);
  const cv::Mat found = net.forward(output);
  const int dims = found.dims;
  const auto pixels = static_cast<std::size_t>(fit.width_px) * std::size_t(fit.height_px);
  const bool has_size = found.type() == CV_32F && dims >= 2 && dims <= 4 &&
                        found.size[dims - 1] == fit.width_px &&
                        found.size[dims - 2] == fit.height_px;
  // Two channels are a flow (u, v): the first is the disparity.
  if (!has_size || (found.total() != pixels && found.total() != 2 * pixels))
    throw InputError(outputShapeText(found, fit));
  cv::Mat plane(fit.height_px, fit.width_px, CV_32F, const_cast<uchar*>(found.data));
  cv::Mat part = plane(cv::Rect(0, 0, fit.used_width, fit.used_height)).clone();
  long negative = 0, positive = 0;
  for (float& d : cv::Mat_<float>(part)) {
    if (!std::isfinite(d)) d = kNotMeasured<float>;
    negative += d < 0;
    positive += d > 0;
  }
  const double scale = double(left.width_px) / fit.used_width * (negative > positive ? -1 : 1);
  if (fit.used_width != left.width_px || fit.used_height != left.height_px)
    cv::resize(part, part, {left.width_px, left.height_px}, 0, 0, cv::INTER_LINEAR);
  Raster<float> disparity_px(left.width_px, left.height_px);
  part.convertTo(opencvView(disparity_px), CV_32F, scale);
  return disparity_px;
}

/// In the child. Throws InputError.
void DisparityNetwork::Impl::runTrialPair(int width_px, int height_px, int disparity_max_px) const {
  const Fit fit = fitOf(width_px, height_px);
  Raster<float> disparity_px;
  try {
    cv::dnn::Net net = load(fit);
    const ColourImage wide = trialImage(width_px + kTrialShiftPx, height_px);
    disparity_px =
        run(net, fit, columnsOf(wide, 0, width_px), columnsOf(wide, kTrialShiftPx, width_px));
  } catch (const cv::Exception& problem) {
    failImport(problem, fit);
  }
  float low = std::numeric_limits<float>::infinity(), high = -low;
  std::size_t in_range = 0;
  for (const float d : disparity_px.values) {
    low = std::min(low, d);
    high = std::max(high, d);
    in_range += d > 0 && d <= static_cast<float>(disparity_max_px);
  }
  const std::string on = " on a trial pair of " + sizeText(width_px, height_px) +
                         " pixels, shifted by " + std::to_string(kTrialShiftPx);
  if (!(low <= high))
    throw InputError(file + ": its output " + printable(output) + " has no finite value" + on +
                     ". Does stereo.model_input fit, and are its weights whole?");
  if (2 * in_range >= disparity_px.size()) return;
  std::ostringstream range;
  range << low << " to " << high;
  throw InputError(file + ": its output " + printable(output) + " is " + range.str() + on +
                   ", but disparities above 0, up to stereo.disparity_max_px, are expected. Is the "
                   "left image its first input, and does stereo.model_input fit?");
}

/// Operators that OpenCV does not have; empty: it has all. In the child.
std::string DisparityNetwork::Impl::lackingOperators() const {
  std::string lacking;
  for (const OnnxOperator& wanted : model.operators) {
    bool is_lacking = !wanted.domain.empty();
    const std::string probe = oneNodeModel(wanted);
    if (!is_lacking && wanted.inputs <= 16) try {
        cv::dnn::readNetFromONNX(probe.data(), probe.size());
      } catch (const cv::Exception& problem) {
        is_lacking = std::string(problem.what()).find("Can't create layer") != std::string::npos;
      }
    if (!is_lacking) continue;
    const std::string domain = wanted.domain.empty() ? "" : wanted.domain + ".";
    lacking += (lacking.empty() ? "" : ", ") + printable(domain + wanted.name);
  }
  return lacking;
}

void DisparityNetwork::Impl::failImport(const cv::Exception& problem, const Fit& fit) const {
  const std::string reader = std::string("OpenCV ") + cv::getVersionString();
  const std::string lacking = lackingOperators();
  if (!lacking.empty())
    throw InputError(file + ": " + reader + " lacks operators of this network: " + lacking +
                     ". Export it without them, or take another network");
  throw InputError(file + ": " + reader + " can't run this network on images of " +
                   sizeText(fit.width_px, fit.height_px) + " pixels: " + oneLine(problem.err) +
                   ". Export it for a fixed size and an older opset (11), or take another network");
}

DisparityNetwork::DisparityNetwork(const std::string& file, NetworkInput input)
    : impl_(std::make_unique<Impl>(file, input)) {
  impl_->read();
}

DisparityNetwork::~DisparityNetwork() = default;

void DisparityNetwork::prepare(int width_px, int height_px, int disparity_max_px) {
  const Fit fit = impl_->fitOf(width_px, height_px);
  const std::pair<int, int> size{fit.width_px, fit.height_px};
  if (impl_->nets.count(size) != 0) return;
  guardedRead(
      impl_->file, impl_->bytes.size(),
      [&] {
        cv::setNumThreads(1);
        cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
        impl_->runTrialPair(width_px, height_px, disparity_max_px);
        return std::string();
      },
      kTrialAllowance);
  impl_->nets.emplace(size, impl_->load(fit));
}

Raster<float> DisparityNetwork::disparity(const ColourImage& left, const ColourImage& right) {
  const Fit fit = impl_->fitOf(left.width_px, left.height_px);
  const auto net = impl_->nets.find({fit.width_px, fit.height_px});
  if (net == impl_->nets.end()) throw Error(impl_->file + ": is run before it was prepared");
  try {
    return impl_->run(net->second, fit, left, right);
  } catch (const cv::Exception& problem) {
    throw InputError(impl_->file + ": OpenCV can't run this network: " + oneLine(problem.err));
  }
}

}  // namespace softscope
