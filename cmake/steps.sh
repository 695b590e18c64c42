# cmake/steps.sh: what demo.sh and test.sh share: numbered steps, packages, configure, build.
# A step that has nothing to do says so and costs no time, no network and no rights.

cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit
step_number=0
step_count=0  # set by the caller

# step TITLE: closes the step before, opens the next.
step() {
  finish_step
  step_number=$((step_number + 1))
  step_started=$SECONDS
  echo "[$step_number/$step_count] $1"
}

finish_step() {
  if [ "$step_number" -gt 0 ]; then echo "      $(duration $((SECONDS - step_started)))"; fi
}

# duration SECONDS: 45 s, 3 min 20 s.
duration() {
  if [ "$1" -lt 60 ]; then echo "$1 s"; else printf '%d min %02d s\n' $(($1 / 60)) $(($1 % 60)); fi
}

say() { echo "      $*"; }

# fail LINE…: the reason, what to do; ends the script.
fail() {
  printf 'error: %s\n' "$@" >&2
  exit 1
}

# logged FILE COMMAND…: runs quietly; shows the end of the log if the command fails.
logged() {
  local log=$1
  shift
  mkdir -p "$(dirname "$log")"
  if ! "$@" >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    fail "$1 failed, see above and $log"
  fi
}

# --- packages -----------------------------------------------------------------------------------

wanted_packages() { sed 's/#.*//' packages.txt | tr -s '[:space:]' '\n' | grep . | LC_ALL=C sort -u; }

installed_packages() {
  dpkg-query -W -f='${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p' | LC_ALL=C sort -u
}

missing_packages() { LC_ALL=C comm -23 <(wanted_packages) <(installed_packages); }

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    env DEBIAN_FRONTEND=noninteractive "$@"
  elif command -v sudo >/dev/null; then
    sudo env DEBIAN_FRONTEND=noninteractive "$@"
  else
    fail "packages are missing, and this is neither root nor is there sudo. As root, run:" \
      "  apt-get install --no-install-recommends $(missing_packages | tr '\n' ' ')"
  fi
}

# apt_progress: from apt-get's many lines, every hundredth package.
apt_progress() {
  awk '/newly installed/ { total = $3 }
       /^Need to get/ { print "      " $0; fflush() }
       /^Setting up / { if (++done % 100 == 0) { print "      set up " done " of " total; fflush() } }'
}

# install_packages yes|no: installs what packages.txt names and this machine lacks.
install_packages() {
  step "Packages of packages.txt"
  if ! command -v dpkg-query >/dev/null; then
    say "this is no Debian: the libraries that packages.txt names must be here already"
    return
  fi
  local missing
  mapfile -t missing < <(missing_packages)
  if [ "${#missing[@]}" -eq 0 ]; then
    say "all $(wanted_packages | wc -l) are here"
    return
  fi
  say "missing: ${missing[*]}"
  if [ "$1" = no ]; then
    say "not installed, as asked; the build may stop for want of them"
    return
  fi
  mkdir -p build
  as_root apt-get update -q >build/packages.log 2>&1 ||
    say "apt-get update complained (build/packages.log); trying with the lists that are here"
  if ! as_root apt-get install -y -q --no-install-recommends "${missing[@]}" 2>&1 |
    tee -a build/packages.log | apt_progress; then
    tail -n 20 build/packages.log >&2
    fail "apt-get could not install the packages, see above and build/packages.log"
  fi
}

# --- build --------------------------------------------------------------------------------------

# configure PRESET: several files are compiled at once, as everything is compiled.
configure() {
  local folder=build/$1
  step "Configure $folder"
  if [ "$folder/build.ninja" -nt CMakePresets.json ]; then
    say "done before; the build repeats it by itself where a CMakeLists.txt changed"
    return
  fi
  logged "$folder/configure.log" cmake --preset "$1" -DSOFTSCOPE_JOIN=ON
  say "$(grep -o 'softscope: .*' "$folder/configure.log" || echo configured)"
}

# build PRESET [TARGET…]
build() {
  local preset=$1
  shift
  step "Build build/$preset${*:+: $*}"
  python3 cmake/progress.py build "$preset" "$@" ||
    fail "the build of build/$preset failed, see above"
}
