# shellcheck shell=sh
# Sourced by tests whose cases are files: TAP of what was expected against what came.
n=0
failed=0

# same NAME: says whether the files `wanted` and `got` are equal, and where not.
same()
{
  n=$((n + 1))
  if diff wanted got >difference; then
    echo "ok $n - $1"
  else
    echo "not ok $n - $1"
    sed 's/^/# /' difference
    failed=1
  fi
}

# The plan, and what a test's script ends with.
same_end()
{
  echo "1..$n"
  exit $failed
}
