// vtk_views/drawing/paper_sheet.cpp: cursor from top to bottom.
#include "vtk_views/drawing/paper_sheet.h"

#include <algorithm>

#include "vtk_views/drawing/html_text.h"

namespace softscope {
namespace {

constexpr double kLeading = 1.32;  // line spacing, in units of the font size
constexpr Rgb8 kGrey{100, 100, 100}, kNoticeRed{150, 20, 20};

double widthOf(const std::string& words, double size_pt, bool bold) {
  DrawnText text;
  text.text = words;
  text.size_pt = size_pt;
  text.bold = bold;
  return textWidthPt(text);
}

/// Length of the longest prefix of a word that fits, at least one character.
std::size_t fittingLength(const std::string& word, double width_pt, double size_pt, bool bold) {
  std::size_t length = word.size();
  while (length > 1 && widthOf(word.substr(0, length), size_pt, bold) > width_pt) {
    --length;
    while (length > 1 && (static_cast<unsigned char>(word[length]) & 0xC0) == 0x80) --length;
  }
  return length;
}

/// Translates a part of a drawing.
struct Mover {
  PointPt by;

  PointPt moved(PointPt p) const { return {p.x_pt + by.x_pt, p.y_pt + by.y_pt}; }
  std::vector<PointPt> moved(std::vector<PointPt> points) const {
    for (PointPt& p : points) p = moved(p);
    return points;
  }
  DrawnLine operator()(DrawnLine line) const {
    line.points = moved(std::move(line.points));
    return line;
  }
  DrawnShape operator()(DrawnShape shape) const {
    shape.points = moved(std::move(shape.points));
    return shape;
  }
  DrawnText operator()(DrawnText text) const {
    text.at = moved(text.at);
    return text;
  }
  DrawnDots operator()(DrawnDots dots) const {
    dots.centres = moved(std::move(dots.centres));
    return dots;
  }
  DrawnPicture operator()(DrawnPicture picture) const {
    picture.top_left = moved(picture.top_left);
    picture.bottom_right = moved(picture.bottom_right);
    return picture;
  }
};

}  // namespace

std::vector<std::string> wordsOfText(const std::string& text) {
  std::vector<std::string> words{""};
  for (const char c : validUtf8(text))
    if (static_cast<unsigned char>(c) <= 0x20)
      words.emplace_back();
    else
      words.back() += c;
  words.erase(std::remove(words.begin(), words.end(), ""), words.end());
  return words;
}

std::vector<std::string> brokenLines(const std::string& text, double width_pt, double size_pt,
                                     bool bold) {
  std::vector<std::string> lines{""};
  for (std::string word : wordsOfText(text)) {
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (widthOf(longer, size_pt, bold) <= width_pt) {
      lines.back() = longer;
      continue;
    }
    if (!lines.back().empty()) lines.emplace_back();
    while (widthOf(word, size_pt, bold) > width_pt) {
      const std::size_t length = fittingLength(word, width_pt, size_pt, bold);
      if (length == word.size()) break;
      lines.back() = word.substr(0, length);
      lines.emplace_back();
      word.erase(0, length);
    }
    lines.back() = word;
  }
  return lines;
}

void PaperSheet::newPage() {
  VectorDrawing page;
  page.width_pt = kWidthPt;
  page.height_pt = kHeightPt;
  pages_.push_back(std::move(page));
  y_pt_ = kTopPt;
}

void PaperSheet::ensure(double height_pt) {
  if (y_pt_ + height_pt > kHeightPt - kBottomPt && y_pt_ > kTopPt) newPage();
}

void PaperSheet::text(const std::string& words, const SheetText& style) {
  const double line_pt = kLeading * style.size_pt;
  for (const std::string& line :
       brokenLines(words, kTextWidthPt - style.indent_pt, style.size_pt, style.bold)) {
    ensure(line_pt);
    DrawnText text;
    text.at = {kSidePt + style.indent_pt, y_pt_ + style.size_pt};
    text.text = line;
    text.size_pt = style.size_pt;
    text.bold = style.bold;
    text.colour = style.colour;
    page().parts.emplace_back(std::move(text));
    y_pt_ += line_pt;
  }
  y_pt_ += style.after_pt;
}

void PaperSheet::put(const VectorDrawing& drawing, PointPt top_left) {
  for (const auto& part : drawing.parts)
    std::visit([&](const auto& p) { page().parts.emplace_back(Mover{top_left}(p)); }, part);
}

void PaperSheet::rule(Rgb8 colour, double width_pt) {
  page().parts.emplace_back(
      DrawnLine{{{kSidePt, y_pt_}, {kWidthPt - kSidePt, y_pt_}}, width_pt, colour});
  y_pt_ += 5;
}

std::vector<VectorDrawing> PaperSheet::finished(const std::string& notice) const {
  std::vector<VectorDrawing> pages = pages_;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    DrawnText top;
    top.at = {kSidePt, 34};
    top.text = validUtf8(notice);
    top.size_pt = 8.5;
    top.bold = true;
    top.colour = kNoticeRed;
    pages[i].parts.emplace_back(top);
    DrawnText foot;
    foot.at = {kWidthPt - kSidePt, kHeightPt - 26};
    foot.text = std::to_string(i + 1) + " / " + std::to_string(pages.size());
    foot.size_pt = 8;
    foot.anchor = TextAnchor::kEnd;
    foot.colour = kGrey;
    pages[i].parts.emplace_back(foot);
  }
  return pages;
}

}  // namespace softscope
