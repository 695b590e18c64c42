#!/usr/bin/env bash
# Builds softscope on a bare Debian 12 and runs the whole suite, under sanitizers too.
set -euo pipefail

usage() {
  cat <<'EOF'
usage: ./test.sh [--fast] [--no-install] [--help]
  Installs what is missing of packages.txt (as root or by sudo), checks the format, builds and runs
  the suite under AddressSanitizer and UndefinedBehaviorSanitizer, then as it is released; ends
  with ctest's summary. What was built before is not built again.
  --fast         leaves the sanitizers out
  --no-install   never calls apt-get
  SOFTSCOPE_TEST_DATA=FOLDER   where the larger test data lie; without it those tests are skipped
EOF
}

install=yes
sanitize=yes
for argument in "$@"; do
  case $argument in
    --fast) sanitize=no ;;
    --no-install) install=no ;;
    --help | -h) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done

source "$(dirname "${BASH_SOURCE[0]}")/cmake/steps.sh"
step_count=5
if [ "$sanitize" = yes ]; then step_count=8; fi

# run_suite PRESET [CTEST OPTION…]
run_suite() {
  local preset=$1
  shift
  ctest --preset "$preset" --parallel "$(nproc)" --no-label-summary "$@" ||
    fail "tests failed in build/$preset; all they said: build/$preset/Testing/Temporary/LastTest.log"
}

check_format() {
  step "Format of the sources"
  if ! clang-format --version 2>/dev/null | grep -q 'version 14\.'; then
    say "not checked: clang-format 14 is not installed, and others disagree in places"
    return
  fi
  find src eval vtk_views apps cuda tests cmake \( -name '*.h' -o -name '*.cpp' -o -name '*.cu' \) -print0 |
    xargs -0 clang-format --dry-run -Werror ||
    fail "some sources are not formatted; run clang-format -i on the files named above"
  say "as .clang-format says"
}

install_packages "$install"
check_format
if [ "$sanitize" = yes ]; then
  configure sanitize
  build sanitize
  step "Tests under sanitizers"
  # The studies of accuracy run the same code as their stages' tests, over minutes of pictures; the
  # workflows run the same program as the tests of apps.
  run_suite sanitize --label-exclude 'stereo_study|features_data|studies'
fi
configure release
build release
step "The whole suite"
say "larger test data: ${SOFTSCOPE_TEST_DATA:-none, SOFTSCOPE_TEST_DATA is not set}"
run_suite release
echo "Done in $SECONDS s. All that the tests said: build/release/Testing/Temporary/LastTest.log"
