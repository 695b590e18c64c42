// tests/house/suppressed_leak.cpp: a leak in a suppressed library, of which nothing is said.
#include <fontconfig/fontconfig.h>

int main() {
  FcPattern* kept = FcNameParse(reinterpret_cast<const FcChar8*>("Sans"));
  return kept == nullptr ? 1 : 0;
}
