#!/usr/bin/env bash
# Builds softscope on a bare Debian 12 and runs the whole suite as it is released.
set -euo pipefail

usage() {
  cat <<'EOT'
usage: ./test.sh [--sanitize] [--no-install] [--help]
  Installs what is missing of packages.txt (as root or by sudo), checks the format, builds what is
  not built yet and runs the whole suite, with a count and the time left all the while. Where tests
  fail, the last lines name them, what they said, and how to run each alone.
  --sanitize     also builds the benchmarks, tries an unoptimised build, and runs the suite under
                 AddressSanitizer and UndefinedBehaviorSanitizer: three times as long
  --no-install   never calls apt-get
  SOFTSCOPE_TEST_DATA=FOLDER   where the larger test data lie; without it those tests are skipped
EOT
}

install=yes
sanitize=no
for argument in "$@"; do
  case $argument in
    --sanitize) sanitize=yes ;;
    --no-install) install=no ;;
    --help | -h) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done

source "$(dirname "${BASH_SOURCE[0]}")/cmake/steps.sh"
step_count=5
if [ "$sanitize" = yes ]; then step_count=12; fi

# run_suite PRESET [CTEST OPTION…]: its last lines are those of the tests that failed.
run_suite() {
  python3 cmake/progress.py test "$@" || exit 1
}

check_format() {
  step "Format of the sources"
  if ! clang-format --version 2>/dev/null | grep -q 'version 14\.'; then
    say "not checked: clang-format 14 is not installed, and others disagree in places"
    return
  fi
  find src eval vtk_views toolkit include python apps packaging cuda tests cmake \( -name '*.h' -o -name '*.cpp' -o -name '*.cu' \) -print0 |
    xargs -0 clang-format --dry-run -Werror ||
    fail "some sources are not formatted; run clang-format -i on the files named above"
  say "as .clang-format says"
}

# Without optimisation functions stand alone that are otherwise inlined into their callers: two types
# of one name, for instance, then share one destructor.
try_unoptimised() {
  local clip=build/smoke/clip run=build/smoke/run
  step "A clip reconstructed by the unoptimised build"
  logged build/smoke/simulate.log build/release/apps/softscope simulate --out "$clip" --frames 4 \
    --size 160x120 --force --quiet
  logged build/smoke/reconstruct.log build/smoke/apps/softscope reconstruct "$clip" --out "$run" \
    --force --quiet
  logged build/smoke/evaluate.log build/release/apps/softscope evaluate "$run" --reference "$clip" \
    --fail-if 'surface.observed.p95_mm>1' --force --quiet
  say "$(grep 'frames ' build/smoke/reconstruct.log)"
}

install_packages "$install"
check_format
configure release
build release
step "The whole suite"
say "larger test data: ${SOFTSCOPE_TEST_DATA:-none, SOFTSCOPE_TEST_DATA is not set}"
if [ "$sanitize" = no ]; then
  run_suite release
else
  # Damaged inputs and random bytes are tried under sanitizers, where they find more.
  run_suite release --exclude-regex '^(mutation|fuzz)[.]'
  build release benchmarks
  configure smoke
  build smoke softscope
  try_unoptimised
  configure sanitize
  build sanitize
  step "Tests under sanitizers"
  # The studies of accuracy run the same code as their stages' tests, over minutes of pictures; the
  # workflows and a newcomer's first hour run the same program as the tests of apps.
  run_suite sanitize --label-exclude 'stereo_study|features_data|studies' \
    --exclude-regex '^house[.]first_hour$'
fi
finish_step
echo "Done in $(duration "$SECONDS"). All that the tests said: build/release/Testing/Temporary/LastTest.log"
