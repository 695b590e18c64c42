#include "toolkit/calibration/board_film.h"

#include <memory>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "io/sequences/frame_pairing.h"
#include "io/sequences/picture_source.h"
#include "io/sequences/stereo_packing.h"
#include "io/text/message.h"

namespace softscope {
namespace {

constexpr int kUsualFrames = 300;
constexpr int kBatch = 8;  // frames in memory, searched in parallel

struct GrayPair {
  int frame = 0;
  GrayImage left, right;
};

/// Source of frame pairs in ascending order.
class PairSource {
 public:
  explicit PairSource(const BoardFilmOptions& options) : options_(options) {
    left_ = openPictures(options.left);
    if (options.right.empty()) return;
    right_ = openPictures(options.right);
    requirePartners({options.left, left_->files(), left_->count()},
                    {options.right, right_->files(), right_->count()});
  }

  int count() const { return left_->count(); }
  bool survivesErrors() const {
    return left_->survivesErrors() && (!right_ || right_->survivesErrors());
  }

  GrayPair read(int index) {
    const ColourImage first = left_->read(index);
    if (right_) return checked({index, toGray(first), toGray(right_->read(index))});
    if (!packing_)
      packing_ =
          choosePacking(first, options_.layout, options_.right_first, {}, left_->nameOf(index));
    const StereoPair pair = unpack(first, *packing_, left_->nameOf(index));
    return checked({index, toGray(pair.left), toGray(pair.right)});
  }

 private:
  GrayPair checked(GrayPair pair) {
    if (width_px_ == 0) {
      width_px_ = pair.left.width_px;
      height_px_ = pair.left.height_px;
    }
    for (const GrayImage* image : {&pair.left, &pair.right})
      if (image->width_px != width_px_ || image->height_px != height_px_)
        throw InputError(say(left_->nameOf(pair.frame), ": the ",
                             image == &pair.left ? "left" : "right", " image is ", image->width_px,
                             " x ", image->height_px, " pixels, but the first left one is ",
                             width_px_, " x ", height_px_,
                             ". Give images of both cameras in one size."));
    return pair;
  }

  const BoardFilmOptions& options_;
  std::unique_ptr<PictureSource> left_, right_;
  std::optional<StereoPacking> packing_;
  int width_px_ = 0, height_px_ = 0;
};

BoardSighting sight(const GrayPair& pair, const BoardOptions& board) {
  BoardSighting sighting;
  sighting.frame = pair.frame;
  sighting.left = findBoard(pair.left, board);
  sighting.right = findBoard(pair.right, board);
  matchOrder(sighting.left, board, &sighting.right);
  sighting.edge_width_px = std::max(edgeWidthPx(pair.left, sighting.left, board),
                                    edgeWidthPx(pair.right, sighting.right, board));
  return sighting;
}

void addBatch(const std::vector<GrayPair>& pairs, const BoardOptions& board, BoardFilm* film) {
  std::vector<BoardSighting> sightings(pairs.size());
  parallelRanges(static_cast<int>(pairs.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto k = static_cast<std::size_t>(i);
      sightings[k] = sight(pairs[k], board);
    }
  });
  for (BoardSighting& sighting : sightings) {
    film->in_left += !sighting.left.empty();
    film->in_right += !sighting.right.empty();
    if (!sighting.left.empty() && !sighting.right.empty() && std::isfinite(sighting.edge_width_px))
      film->sightings.push_back(std::move(sighting));
  }
  film->frames += static_cast<int>(pairs.size());
}

void requireSightings(const BoardFilm& film, const BoardFilmOptions& options) {
  if (!film.sightings.empty() || film.stopped) return;
  const BoardOptions& board = options.board;
  throw InputError(say(
      shown(options.left), ": of ", film.frames, " frames ", film.in_left,
      " show the board in the left view, ", film.in_right, " in the right one and none in both, ",
      "but a board of ", board.columns, " x ", board.rows,
      board.hasMarkers() ? " squares with markers" : " inner corners",
      " is expected. Is `board=` right (inner corners of a checkerboard: one fewer than squares; "
      "squares of a ChArUco board), and the whole board in the image?"));
}

}  // namespace

void BoardFilmOptions::validate() const {
  board.validate();
  require(every >= 0, "`every=`", every, "can't be negative");
  require(layout == "auto" || right.empty(), "`layout=`", layout,
          "is for one film with both views; leave RIGHT out");
}

BoardFilm readBoardFilm(const BoardFilmOptions& options, const Progress& progress) {
  options.validate();
  PairSource source(options);
  const int count = source.count();
  const int step = options.every > 0 ? options.every : std::max(1, (count - 1) / kUsualFrames + 1);
  BoardFilm film;
  std::vector<GrayPair> batch;
  if (!reportProgress(progress, 0, count)) film.stopped = true;
  for (int frame = 0; frame < count && !film.stopped; frame += step) {
    try {
      batch.push_back(source.read(frame));
      film.width_px = batch.back().left.width_px;
      film.height_px = batch.back().left.height_px;
    } catch (const InputError& problem) {
      if (frame == 0) throw;
      film.unreadable.push_back(problem.what());
      if (!source.survivesErrors()) break;
    }
    if (batch.size() < kBatch && frame + step < count) continue;
    addBatch(batch, options.board, &film);
    batch.clear();
    film.stopped = !reportProgress(progress, std::min(count, frame + step), count);
  }
  if (!film.stopped) addBatch(batch, options.board, &film);
  requireSightings(film, options);
  return film;
}

}  // namespace softscope
