# Doxygen reads the Markdown pages through this: links to headers lead to their pages, pictures are found by their names,
# links to what has no page here (folders, the Makefile) become plain text, and @ is no command.
function linked(text, target) {
  if (target ~ /^https?:|[.]md$/) return "[" text "](" target ")"
  if (target !~ /[.](hpp|png|webp)$/) return text
  sub(/.*\//, "", target)
  return "[" text "](" (target ~ /hpp$/ ? "@ref " : "") target ")"
}
/^```/ {code = !code}
!code {
  gsub(/@/, "\\@")
  rest = $0
  $0 = ""
  while (match(rest, /\[[^]]*\]\([^)]*\)/)) {
    link = substr(rest, RSTART + 1, RLENGTH - 2)
    $0 = $0 substr(rest, 1, RSTART - 1) linked(substr(link, 1, index(link, "](") - 1), substr(link, index(link, "](") + 2))
    rest = substr(rest, RSTART + RLENGTH)
  }
  $0 = $0 rest
}
{print}
