# Sourced by experiments/run, tests/run and benchmarks/run (bash, set -euo pipefail): installs what is
# missing, configures and builds. Defines `root`, the project's folder, and drape_build.

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
{ true <&0; } 2>/dev/null || exec </dev/null  # started with a closed stdin

# One BLAS thread, should a threaded BLAS be the one installed.
export OPENBLAS_NUM_THREADS=1

say() { printf '%s\n' "$*" >&2; }

# Prints the packages of .ci/packages that are not installed.
missing_packages() {
  local wanted installed
  wanted=$(grep -Eo '^[a-z0-9][^ #]*' "$root/.ci/packages" | sort)
  installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' $wanted 2>/dev/null |
              sed -n 's/^installed //p' | sort -u || true)
  comm -23 <(printf '%s\n' "$wanted") <(printf '%s\n' "$installed")
}

install_packages() {
  local missing apt
  if ! command -v dpkg-query >/dev/null; then
    say "Drape is set up with Debian 12 packages, and this system has no dpkg. Needed: .ci/packages"
    exit 2
  fi
  missing=$(missing_packages | tr '\n' ' ')
  if [[ -z ${missing// /} ]]; then return; fi

  apt="apt-get install -y --no-install-recommends ${missing% }"
  local as_root=()
  if (( EUID != 0 )); then
    if command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [[ -t 0 && -t 2 ]]; }; then
      as_root=(sudo)
    else
      say "Some packages are missing, and only root can install them. Please run:"
      say "  sudo apt-get update && sudo $apt"
      exit 2
    fi
  fi
  say "Installing $(wc -w <<<"$missing") missing packages with apt: ${missing% }"
  local log=$root/build/apt.log
  mkdir -p "$root/build"
  local wait_for_lock="-o DPkg::Lock::Timeout=600"
  if ! { "${as_root[@]}" apt-get $wait_for_lock update &&
         "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive $apt $wait_for_lock; } \
       </dev/null >"$log" 2>&1; then
    tail -n 15 "$log" >&2
    say "apt failed (log: $log). Please repair that, or run by hand:"
    say "  sudo apt-get update && sudo $apt"
    exit 2
  fi
}

# As many compilers as processors, as long as each has 2 GB of memory.
build_jobs() {
  local jobs fit
  jobs=$(nproc)
  fit=$(awk '/^MemAvailable:/ {print int($2 / 2097152)}' /proc/meminfo)
  if (( fit < jobs )); then jobs=$fit; fi
  echo $(( jobs > 0 ? jobs : 1 ))
}

# Copies ninja's output to the file $1; shows where it stands once it has taken a second.
show_progress() {
  local line part="" step="" shown=-1 status begin=$SECONDS every=15 end=$'\n'
  if [[ -t 2 ]]; then every=1 end=$'\r'; fi
  exec 3>"$1"
  while true; do
    status=0
    IFS= read -r -t 1 line || status=$?
    part+=$line
    if (( status == 0 )); then
      printf '%s\n' "$part" >&3
      if [[ $part =~ ^\[([0-9]+/[0-9]+)\] ]]; then step=${BASH_REMATCH[1]}; fi
      part=""
    elif (( status <= 128 )); then  # the end, not a time-out
      break
    fi
    if (( SECONDS > begin && (shown < 0 || SECONDS - shown >= every) )); then
      printf 'Building Drape: %s (%d s)   %s' "${step:-...}" $((SECONDS - begin)) "$end" >&2
      shown=$SECONDS
    fi
  done
  printf '%s' "$part" >&3
  exec 3>&-
  if (( shown >= 0 )) && [[ -t 2 ]]; then printf '\n' >&2; fi
}

# drape_build PRESET [TARGET...]: brings build/PRESET up to date (all targets by default). Prints
# nothing if there is nothing to do; exits 1 with the end of the log if the build fails.
drape_build() {
  local preset=$1
  shift
  install_packages
  local dir=$root/build/$preset
  mkdir -p "$dir"
  exec 9>"$dir/.lock"
  if ! flock -n 9; then
    say "Waiting for another build in $dir"
    flock 9
  fi

  local cache=$dir/CMakeCache.txt fresh=()
  if [[ -e $cache ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then
    fresh=(--fresh)  # the project's folder was moved or copied
  fi
  if [[ ! $dir/build.ninja -nt $root/CMakePresets.json || ${#fresh[@]} -gt 0 ]]; then
    if ! (cd "$root" && cmake "${fresh[@]}" --preset "$preset") </dev/null 9>&- \
         >"$dir/configure.log" 2>&1; then
      tail -n 30 "$dir/configure.log" >&2
      say "Configuring failed; log: $dir/configure.log"
      exit 1
    fi
  fi

  if ! ninja -C "$dir" -j "$(build_jobs)" "$@" </dev/null 2>&1 9>&- |
       show_progress "$dir/build.log"; then
    grep -E -A 12 -m 3 '^FAILED:|error:|CMake Error' "$dir/build.log" >&2 ||
      tail -n 30 "$dir/build.log" >&2
    say "The build failed; log: $dir/build.log"
    exit 1
  fi
  exec 9>&-
}
