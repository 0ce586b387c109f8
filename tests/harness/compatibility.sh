#!/bin/sh
# doc/compatibility.md: one row for every reserved word, from src/lang/keywords.def,
# doc/compatibility.exceptions, the tests a word occurs in and what the program says of
# the scenes in tests/words.
#   compatibility.sh --update   writes the table (make update-compatibility)
#   compatibility.sh            checks it, in TAP
top=$(cd "${top_srcdir:-.}" && pwd)
lambert=$(cd "${top_builddir:-.}" && pwd)/lambert
table=$top/doc/compatibility.md
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

# Lines "E0900 word": not built.
probe()
{
  (cd "$work" && for scene in "$top"/tests/words/*.pov; do
    "$lambert" "$scene" --dump-csg --max-errors=0 --diagnostics=json 2>&1 >/dev/null
  done) | sed -n "s/.*\"code\":\"\(E090[01]\)\".*\"msg\":\"'\([a-z_0-9]*\)' is .*/\1 \2/p" |
    sort -u
}

# Lines "word file": the first test a word occurs in. Of C files only the strings.
tests_of_words()
{
  (cd "$top" && find tests/lang tests/words tests/shading tests/stability tests/unit \
    scenes -name '*.scn' -o -name '*.pov' -o -name '*.[ch]' -o -name 'cases.def' |
    LC_ALL=C sort | sed 's|^\(tests/lang\)|0 \1|; s|^\(tests/words\)|2 \1|; s|^[st]|1 &|' |
    LC_ALL=C sort | sed 's/^[0-9] //' | xargs awk '
      FILENAME ~ /\.[ch]$/ && !/"/ {next}
      {
        if (FILENAME ~ /\.(scn|pov)$/) {
          gsub(/"[^"]*"/, "")
          sub(/\/\/.*/, "")
        }
        n = split($0, word, /[^A-Za-z0-9_]+/)
        for (i = 1; i <= n; i++)
          if (word[i] ~ /^[a-z][a-z0-9_]*$/ && !(word[i] in seen)) {
            seen[word[i]] = 1
            print word[i], FILENAME
          }
      }')
}

rows()
{
  probe >"$work/probed"
  tests_of_words >"$work/tests"
  awk -v probed="$work/probed" -v tests="$work/tests" \
    -v exceptions="$top/doc/compatibility.exceptions" '
    function status_of(word) {
      if (word in code)
        return "missing"
      return word in owner && owner[word] in code ? "missing" : word in differs ? "differs" : "same"
    }
    function why(word,  w) {
      w = word in code ? word : owner[word]
      return w == word ? "reported as not built" : "in `" w "`, which is reported as not built"
    }
    BEGIN {
      while ((getline line < probed) > 0) { split(line, f, " "); code[f[2]] = f[1] }
      while ((getline line < tests) > 0) { split(line, f, " "); test[f[1]] = f[2] }
      while ((getline line < exceptions) > 0) {
        if (line ~ /^#/ || line == "")
          continue
        word = line; sub(/:.*/, "", word)
        rest = line; sub(/^[^:]*: */, "", rest)
        if (rest ~ /^part of /) owner[word] = substr(rest, 9)
        else if (rest ~ /^missing /) { code[word] = "E0900"; note[word] = substr(rest, 9) }
        else if (rest ~ /^differs /) { differs[word] = 1; note[word] = substr(rest, 9) }
        else note[word] = rest
      }
    }
    /^WORD\(/ {
      word = $0; sub(/^WORD\(/, "", word); sub(/,.*/, "", word)
      class = $0; sub(/^[^,]*, */, "", class); sub(/\).*/, "", class)
      class = tolower(class); gsub(/__/, ", ", class); gsub(/_/, " ", class)
      status = status_of(word)
      text = word in note ? note[word] : status == "missing" ? why(word) : ""
      if (status != "missing" && word in test)
        text = (text == "" ? "" : text "; ") test[word]
      printf "| `%s` | %s | %s | %s |\n", word, class, status, text
    }' "$top/src/lang/keywords.def"
}

write_table()
{
  rows >"$work/rows"
  {
    echo '# Compatibility with POV-Ray 3.7'
    echo
    echo 'Every reserved word of the language, made by `make update-compatibility`.'
    echo '"same": read and rendered as POV-Ray does, as far as the test of the last column'
    echo 'tells; "missing": the program says so when it meets the word. A least use of each word, and'
    echo 'whether the two programs read it, is a row of `tests/words/words.tsv`, which `words.sh` walks.'
    echo
    awk -F' [|] ' '{n[$3]++} END {
      printf "%d words: %d same, %d different, %d missing.\n", NR, n["same"], n["differs"], n["missing"]}' \
      "$work/rows"
    echo
    echo '| Word | Class | State | Test or note |'
    echo '|---|---|---|---|'
    cat "$work/rows"
  } >"$1"
}

if test "$1" = --update; then
  write_table "$table"
  exit
fi

failed=0
result() # number, name; fails when the file bad holds anything
{
  if test -s "$work/bad"; then
    echo "not ok $1 - $2"
    sed 's/^/# /' "$work/bad"
    failed=1
  else
    echo "ok $1 - $2"
  fi
}
write_table "$work/new"
grep '^| `' "$work/new" >"$work/new.rows"
grep '^| `' "$table" >"$work/old.rows"
cut -d'|' -f2,3 "$work/new.rows" >"$work/a"
cut -d'|' -f2,3 "$work/old.rows" >"$work/b"
diff "$work/a" "$work/b" >"$work/bad"
result 1 'every word has its row; else: make update-compatibility'
cut -d'|' -f2,4 "$work/new.rows" >"$work/a"
cut -d'|' -f2,4 "$work/old.rows" >"$work/b"
diff "$work/b" "$work/a" >"$work/bad"
result 2 'every word is built, or not, as the table says; else: make update-compatibility'
sed -n 's/.*[ |]\(tests[^ ;|]*\|scenes[^ ;|]*\) |$/\1/p' "$work/old.rows" | sort -u |
  while read -r file; do test -f "$top/$file" || echo "$file is gone"; done >"$work/bad"
result 3 'the tests that the table names are there'
grep -E '^\| `[a-z_0-9]*` \| [^|]* \| (same|differs) \|  *\|$' "$work/old.rows" >"$work/bad"
result 4 'every word that is built has a test or a note'
echo 1..4
exit $failed
