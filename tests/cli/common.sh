# shellcheck shell=sh
# Sourced by the command tests: TAP output, a folder of their own, the program.
n=0
failed=0
lambert=$(cd "${top_builddir:-.}" && pwd)/lambert
table=$(cd "${top_srcdir:-.}" && pwd)/src/api/options.def
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
unset POVINI POVINC LAMBERT_PATH

# check NAME COMMAND...: passes when the command does.
check()
{
  name=$1
  shift
  n=$((n + 1))
  if "$@"; then
    echo "ok $n - $name"
  else
    echo "not ok $n - $name"
    failed=1
  fi
}

# exits CODE COMMAND...: output in files out and err.
exits()
{
  code_wanted=$1
  shift
  "$@" >out 2>err
  got=$?
  test $got = "$code_wanted" && return
  echo "# exit code $got, not $code_wanted: $*"
  sed 's/^/# /' err
  return 1
}

has() { grep -q -e "$2" "$1" || { sed 's/^/# /' "$1"; return 1; }; }

# size FILE W H: of a binary PPM or PNG file.
size_ppm() { tr '\0' ' ' <"$1" | grep -a -q "^$2 $3\$"; }

finish()
{
  echo "1..$n"
  exit $failed
}

cat >sphere.pov <<'EOF'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -3> look_at 0 }
light_source { <5, 5, -5>, rgb 1 }
sphere { 0, 1 pigment { rgb <1, 0.5, 0.25> } }
EOF
