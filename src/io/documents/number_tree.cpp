#include "io/documents/number_tree.h"

#include "core/error.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

// Limit of the size; the largest matrix of a calibration is 3 x 4.
constexpr std::size_t kMostInTree = 64;

void append(const Document& document, const std::string& what, std::vector<double>& out);

void appendMatrix(const Document& matrix, const std::string& what, std::vector<double>& out) {
  const Document* data = matrix.find("data");
  if (!data) throw InputError(what + " has no `data`. Write it as OpenCV does: rows, cols, data.");
  const std::size_t before = out.size();
  append(*data, what, out);
  const Document *rows = matrix.find("rows"), *columns = matrix.find("cols");
  if (!rows || !columns) return;
  const auto row_count = numberOf(rows->text), column_count = numberOf(columns->text);
  const auto count = static_cast<double>(out.size() - before);
  if (!row_count || !column_count || *row_count * *column_count != count)
    throw InputError(say(what, " says ", excerpt(rows->text), " x ", excerpt(columns->text),
                         " numbers, but holds ", count, ". Export it again."));
}

void append(const Document& document, const std::string& what, std::vector<double>& out) {
  if (document.kind == Document::Kind::kMap) return appendMatrix(document, what, out);
  for (const Document& item : document.items) append(item, what, out);
  for (const std::string_view word : wordsOf(document.text)) {
    const auto value = numberOf(word);
    if (!value)
      throw InputError(say(what, " holds ", excerpt(word), ", but a number is expected."));
    out.push_back(*value);
  }
  if (out.size() > kMostInTree)
    throw InputError(
        say(what, " holds more than ", kMostInTree, " numbers. Is it the right file?"));
}

}  // namespace

std::vector<double> numbersOf(const Document& document, const std::string& what) {
  std::vector<double> out;
  append(document, what, out);
  return out;
}

}  // namespace softscope
