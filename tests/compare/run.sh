#!/bin/sh
# Renders every sample scene with lambert and with POV-Ray and writes a table.
# usage: run.sh LAMBERT OUT [SCENES-FOLDER]   (JOBS=n: so many at once)
lambert=$1 out=$2 scenes=${3:-/usr/share/doc/povray/examples}
mkdir -p "$out/rows" "$out/cache" || exit 1
rm -f "$out"/rows/*

# row NUMBER:SCENE OPTION...: one scene a process, so that one that brings lambert down takes
# no other with it.
# shellcheck disable=SC2016 # the shell that is told expands them
row='
  number=${3%%:*} scene=${3#*:} lambert=$1 out=$2
  shift 3
  "$lambert" compare "$scene" --csv --out "$out/pictures" --reference-cache "$out/cache" \
    --time-limit 60 +W160 +H120 -A "$@" | tail -n 1 >"$out/rows/$(printf %04d "$number")"
'
find "$scenes" -name '*.pov' | sort | grep -n '' >"$out/list"
xargs -P "${JOBS:-2}" -d '\n' -I NUMBERED sh -c "$row" sh "$lambert" "$out" NUMBERED +WT1 \
  <"$out/list"

# What one thread beside others has no time for gets all threads, and the machine for itself.
grep -l ',"time limit"$' "$out"/rows/* | sed 's,.*/0*,,' | while read -r number; do
  sh -c "$row" sh "$lambert" "$out" "$(sed -n "${number}p" "$out/list")"
done

echo 'scene,verdict,off_percent,rmse,psnr_db,reference_seconds,lambert_seconds,ratio,reason' \
  >"$out/table.csv"
cat "$out"/rows/* | sort -t , -k 2,2 -k 3,3g >>"$out/table.csv"
{
  echo "scenes by verdict:"
  tail -n +2 "$out/table.csv" | cut -d , -f 2 | sort | uniq -c | sort -rn
  echo
  echo "reasons for not rendering:"
  grep ',not rendered,' "$out/table.csv" | sed 's/^.*,"\(.*\)"$/\1/' | sort | uniq -c |
    sort -rn | head -40
  echo
  echo "time, POV-Ray and lambert, over the scenes that match (whole processes):"
  awk -F , '$2 == "match" && $6 > 0 && $7 > 0 {p += $6; l += $7; r += log($6 / $7); n++}
    END {if (n) printf "%.1f s %.1f s, lambert is %.1f times faster in the geometric mean (%d scenes)\n", p, l, exp(r / n), n}' \
    "$out/table.csv"
} | tee "$out/summary.txt"
