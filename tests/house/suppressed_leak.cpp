// tests/house/suppressed_leak.cpp: what a suppressed library keeps costs a sanitized program no word.
#include <fontconfig/fontconfig.h>

int main() {
  FcPattern* kept = FcNameParse(reinterpret_cast<const FcChar8*>("Sans"));
  return kept == nullptr ? 1 : 0;
}
