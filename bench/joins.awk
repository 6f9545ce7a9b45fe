# What each method costs over all scenes, from least to most: out of the baselines of the scenes on the ideal arm, in which
# dmp2 comes first.
function range(metric, format,   from, to) {
  from = shown(least[method, metric], format)
  to = shown(most[method, metric], format)
  return from == to ? from : from " to " to
}
function shown(value, format) {
  return sprintf(format == "%.2g" && value >= 10 ? "%.0f" : format, value)
}
$1 ~ /^"dmp/ {
  gsub(/[":]/, "", $1)
  method = $1
}
$1 ~ /^"(torque_jump_nm|torque_rate_peak_nm_s|jerk_peak_rad_s3|deviation_peak_rad)":/ {
  gsub(/[":]/, "", $1)
  value = $2 + 0
  if ($1 == "torque_jump_nm") {
    if (method == "dmp2") step = value
    value *= 100 / step
  }
  at = method SUBSEP $1
  if (!(at in least) || value < least[at]) least[at] = value
  if (!(at in most) || value > most[at]) most[at] = value
}
END {
  print "| method | torque jump, of dmp2's [%] | peak torque rate [N·m/s] | peak jerk [rad/s³] | deviation [rad] |"
  print "|---|---|---|---|---|"
  count = split("dmp2 dmp2a dmp3 dmp2j", methods, " ")
  for (k = 1; k <= count; ++k) {
    method = methods[k]
    print "| " method " | " range("torque_jump_nm", "%.2g") " | " range("torque_rate_peak_nm_s", "%.0f") " | " \
      range("jerk_peak_rad_s3", "%.0f") " | " range("deviation_peak_rad", "%.3f") " |"
  }
}
