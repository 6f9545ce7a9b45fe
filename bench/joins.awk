# What each method costs over all scenes, from least to most: out of the bench's overview, or a page that holds it.
BEGIN {FS = " *[|] *"}
/^[|] [a-z]+ +[|] dmp/ {
  if (!($3 in seen)) methods[++count] = $3
  seen[$3] = 1
  for (i = 6; i <= 10; ++i) {
    at = $3 SUBSEP i
    if (!(at in least) || $i + 0 < least[at] + 0) least[at] = $i
    if (!(at in most) || $i + 0 > most[at] + 0) most[at] = $i
  }
}
function range(method, i) {
  return least[method, i] == most[method, i] ? least[method, i] : least[method, i] " to " most[method, i]
}
END {
  print "| method | torque jump, of dmp2's [%] | peak torque rate [N·m/s] | peak jerk [rad/s³] | deviation [rad] |"
  print "|---|---|---|---|---|"
  for (k = 1; k <= count; ++k) {
    m = methods[k]
    print "| " m " | " range(m, 6) " | " range(m, 8) " | " range(m, 9) " | " range(m, 10) " |"
  }
}
