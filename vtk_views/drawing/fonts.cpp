// vtk_views/drawing/fonts.cpp: query of fontconfig, as in cairo.
#include "vtk_views/drawing/fonts.h"

#include <fontconfig/fontconfig.h>

#include <memory>

namespace softscope {
namespace {

constexpr const char* kWithArialsWidths[] = {"Arial", "Helvetica", "Liberation Sans"};
constexpr const char* kLastResort = "DejaVu Sans";

std::string chooseFont() {
  for (const char* family : kWithArialsWidths)
    if (findFont(family).family == family) return family;  // else fontconfig returned a substitute
  return kLastResort;
}

std::string textOf(FcPattern* pattern, const char* key) {
  FcChar8* text = nullptr;
  if (FcPatternGetString(pattern, key, 0, &text) != FcResultMatch) return {};
  return reinterpret_cast<const char*>(text);
}

}  // namespace

FontFile findFont(const std::string& family) {
  using Pattern = std::unique_ptr<FcPattern, void (*)(FcPattern*)>;
  const Pattern wanted(FcPatternCreate(), FcPatternDestroy);
  FcPatternAddString(wanted.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>(family.c_str()));
  FcConfigSubstitute(nullptr, wanted.get(), FcMatchPattern);
  FcDefaultSubstitute(wanted.get());
  FcResult outcome = FcResultNoMatch;
  const Pattern found(FcFontMatch(nullptr, wanted.get(), &outcome), FcPatternDestroy);
  if (!found || outcome != FcResultMatch) return {};
  return {textOf(found.get(), FC_FAMILY), textOf(found.get(), FC_FILE)};
}

const std::string& figureFont() {
  static const std::string chosen = chooseFont();
  return chosen;
}

bool figureFontHasArialsWidths() { return figureFont() != kLastResort; }

}  // namespace softscope
