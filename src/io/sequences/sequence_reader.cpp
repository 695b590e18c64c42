#include "io/sequences/sequence_reader.h"

#include <algorithm>
#include <exception>
#include <future>
#include <thread>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "io/sequences/bounded_queue.h"
#include "io/sequences/frame_loader.h"
#include "io/sequences/view_progress.h"
#include "io/text/message.h"

namespace softscope {
namespace {

FrameRange rangeWithin(FrameRange range, int count) {
  if (range.end < 0) range.end = count;
  if (range.begin >= count || range.end > count || range.begin >= range.end || range.count() == 0)
    throw OptionError(say("`frames=` ", range.begin, ":", range.end, ", but the sequence has ",
                          count, " frames, 0:", count, "."));
  return range;
}

/// First frame of the range from `first` on; `first` of the sequence for an empty rest.
int firstFrom(const FrameRange& range, int first) {
  if (first <= range.begin && !range.holdsOut(range.begin)) return range.begin;
  const int steps = std::max(0, first - range.begin + range.step - 1) / range.step;
  int index = range.begin + steps * range.step;
  if (range.holdsOut(index)) index += range.step;
  return index < range.end ? index : first;
}

/// Frame before the first one of the range, as if the range had begun earlier; negative: none.
int frameBefore(const FrameRange& range) {
  const int before = range.begin - range.step;
  return range.holdsOut(before) ? before - range.step : before;
}

/// A frame as read, before it is compared with the one before.
struct LoadedFrame {
  FrameResult result;
  std::optional<PairDigest> digest;  // of two views without depth files
};

std::optional<PairDigest> digestOfFrame(const Frame& frame) {
  if (frame.pair.right.empty() || !frame.depth_mm.empty()) return std::nullopt;
  return digestOf(frame.pair);
}

}  // namespace

class SequenceReader::Impl {
 public:
  Impl(const SequencePaths& paths, const SequenceOptions& options)
      : loader_(paths, options),
        range_(rangeWithin(options.frames, loader_.count())),
        queue_(static_cast<std::size_t>(options.read_ahead)) {
    FrameResult& first = first_.result;
    first.index = firstFrom(range_, loader_.firstWithPartner());
    first.time_s = loader_.timeOf(first.index);
    first.names = loader_.namesOf(first.index);
    if (first.index == range_.begin) readBefore(frameBefore(range_));
    first.frame = loader_.load(first.index);  // throws: the fault concerns the whole sequence
    first_.digest = digestOfFrame(first.frame);
    calibration_ = loader_.calibration();
    thread_ = std::thread([this] { readAhead(); });
  }
  ~Impl() {
    queue_.close();
    thread_.join();
  }

  const StereoCalibration& calibration() const { return calibration_; }
  void expectRows(const RowPlane& rows) { calibration_.rows = rows; }
  int frameCount() const { return range_.count(); }
  int totalCount() const { return loader_.count(); }

  std::optional<FrameResult> next() {
    std::optional<std::future<LoadedFrame>> begun = queue_.pop();
    // The queue is closed after failure_ is set, so its mutex orders both.
    if (!begun && failure_) std::rethrow_exception(failure_);
    if (!begun) return std::nullopt;
    LoadedFrame loaded = begun->get();
    compareWithBefore(&loaded);
    return std::move(loaded.result);
  }

 private:
  void readBefore(int index) {
    if (index < 0 || !loader_.hasPartner(index)) return;
    const LoadedFrame loaded = load(index);
    if (loaded.digest) before_ = EarlierPair{index, *loaded.digest};
  }
  void compareWithBefore(LoadedFrame* loaded) {
    FrameResult& result = loaded->result;
    const std::optional<EarlierPair> before = std::exchange(before_, std::nullopt);
    if (!loaded->digest) return;
    before_ = asEarlier(before, result.index, *loaded->digest);
    result.repeats = before && repeats(before->digest, *loaded->digest);
    result.error = viewProgressFault(before, *loaded->digest, result.names);
    if (result.ok()) return;
    result.frame = {};
    result.unpaired = result.bad_views = true;
  }

  void readAhead() {
    try {
      bool go_on = true;
      for (int index = range_.begin; index < range_.end && go_on; index += range_.step)
        if (!range_.holdsOut(index))
          go_on = index == first_.result.index ? give(first_) : read(index);
    } catch (...) {
      failure_ = std::current_exception();
    }
    queue_.close();
  }

  /// Whether more is to be read: what cannot be read in any order is read one by one.
  bool read(int index) {
    if (loader_.readsInAnyOrder() && threadCount() > 1)
      return queue_.push(std::async(std::launch::async, [this, index] { return load(index); }));
    LoadedFrame loaded = load(index);
    const bool go_on =
        loaded.result.ok() || index < first_.result.index || loader_.survivesErrors();
    return give(loaded) && go_on;
  }
  bool give(LoadedFrame& loaded) {
    std::promise<LoadedFrame> done;
    done.set_value(std::move(loaded));
    return queue_.push(done.get_future());
  }

  LoadedFrame load(int index) {
    LoadedFrame loaded;
    FrameResult& result = loaded.result;
    result.index = index;
    result.time_s = loader_.timeOf(index);
    result.names = loader_.namesOf(index);
    result.unpaired = !loader_.hasPartner(index);
    try {
      result.frame = loader_.load(index);
      loaded.digest = digestOfFrame(result.frame);
    } catch (const InputError& error) {
      result.error = error.what();
    }
    return loaded;
  }

  FrameLoader loader_;  // after the constructor used by readers only, except count()
  FrameRange range_;
  LoadedFrame first_;
  std::optional<EarlierPair> before_;  // of the frame that next() returned last
  StereoCalibration calibration_;
  BoundedQueue<std::future<LoadedFrame>> queue_;  // in order; its readers end before the loader
  std::exception_ptr failure_;
  std::thread thread_;
};

SequenceReader::SequenceReader(const SequencePaths& paths, const SequenceOptions& options)
    : impl_(std::make_unique<Impl>(paths, options)) {}
SequenceReader::SequenceReader(const std::filesystem::path& folder, const SequenceOptions& options)
    : SequenceReader(findSequence(folder), options) {}
SequenceReader::~SequenceReader() = default;
SequenceReader::SequenceReader(SequenceReader&&) noexcept = default;
SequenceReader& SequenceReader::operator=(SequenceReader&&) noexcept = default;

const StereoCalibration& SequenceReader::calibration() const { return impl_->calibration(); }
void SequenceReader::expectRows(const RowPlane& rows) { impl_->expectRows(rows); }
int SequenceReader::frameCount() const { return impl_->frameCount(); }
int SequenceReader::totalCount() const { return impl_->totalCount(); }
std::optional<FrameResult> SequenceReader::next() { return impl_->next(); }

}  // namespace softscope
