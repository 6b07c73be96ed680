# Sourced by the project's other scripts: installs what is missing and builds.

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build="$project/build"

# install_packages [list...]: installs what is missing of the packages of debian-packages.txt and
# of further lists; touches nothing if nothing is.
install_packages()
{
  local package missing=() as_root=()
  while read -r package; do
    if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
      missing+=("$package")
    fi
  done < <(sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$project/Plugin/debian-packages.txt" "$@")
  if [ ${#missing[@]} -eq 0 ]; then
    return
  fi
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "These packages are missing; run as root, or install them: ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}"
  "${as_root[@]}" apt-get update
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -o DPkg::Lock::Timeout=600 install -y --no-install-recommends "${missing[@]}"
}

# configure_project [cmake argument...]: a Release build in build/.
configure_project()
{
  # ParaView's modules are for Debian's Python, whichever else comes first on the PATH.
  cmake -S "$project" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DPython3_EXECUTABLE=/usr/bin/python3 "$@"
}

# build_project [cmake argument...]: configures and builds all of it.
build_project()
{
  configure_project "$@"
  cmake --build "$build"
}
