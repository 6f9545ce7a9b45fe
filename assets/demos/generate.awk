# One demonstration as an optical tracker would see a person make it: see README.md. Positions [m] and
# orientation in the robot's base frame (x forward, y left, z up). Called by generate.sh.

# Numbers in [0, 1) that no awk has its own idea of (Park and Miller 1988).
function uniform() { seed = (seed * 16807) % 2147483647; return seed / 2147483647 }
function normal(   i, sum) { for (i = 0; i < 12; i++) sum += uniform(); return sum - 6 }

# Share of the way after the share s of the time: minimum jerk, fastest at 45 % of the time.
function travelled(s) {
  s = s < 0 ? 0 : s > 1 ? 1 : s
  s += 0.2 * s * (1 - s)
  return s * s * s * (10 + s * (6 * s - 15))
}

# Three sinusoids of 8 to 12 Hz for each of four channels (x, y, z, tilt).
function start_tremor(   c, k) {
  for (c = 1; c <= 4; c++)
    for (k = 1; k <= 3; k++) {
      frequency[c, k] = 8 + 4 * uniform()
      phase[c, k] = 2 * pi * uniform()
    }
}
function tremor(c, t,   k, sum) {
  for (k = 1; k <= 3; k++) sum += sin(2 * pi * frequency[c, k] * t + phase[c, k])
  return sum
}

# A move from (x0, y0, z0) to (x1, y1, z1), raised by `arch` and bent sideways by `bend` half-way.
function move(x0, y0, z0, x1, y1, z1, arch, bend, s,   w, hump, length_xy) {
  w = travelled(s)
  hump = 16 * w * w * (1 - w) * (1 - w)
  length_xy = sqrt((x1 - x0) ^ 2 + (y1 - y0) ^ 2)
  x = x0 + w * (x1 - x0) - bend * hump * (y1 - y0) / length_xy
  y = y0 + w * (y1 - y0) + bend * hump * (x1 - x0) / length_xy
  z = z0 + w * (z1 - z0) + arch * hump
}

# Sets x, y, z and tilt (about the base frame's y) after t seconds of the movement.
function follow(t,   s, p) {
  s = t / duration
  tilt = 0
  if (motion == "reach") move(0.40, -0.25, 0.40, 0.62, 0.12, 0.30, 0.03, 0.03, s)
  if (motion == "carry_lift") move(0.45, -0.30, 0.06, 0.58, -0.06, 0.20, 0.02, 0.015, s)
  if (motion == "carry_place") move(0.58, -0.06, 0.20, 0.50, 0.20, 0.08, 0.02, 0.015, s)
  if (motion == "pour") {
    move(0.62, 0.12, 0.30, 0.66, 0.13, 0.34, 0, 0.004, 1.3 * s)
    tilt = 1.75 * travelled(s)
  }
  if (motion == "wipe_approach") move(0.42, -0.22, 0.22, 0.58, -0.01, 0.02, 0.02, -0.02, s)
  if (motion == "wipe_away") move(0.57, 0.06, 0.03, 0.44, -0.20, 0.24, 0.02, 0.02, s)
  if (motion == "catch") move(0.48, -0.40, 0.45, 0.64, 0.15, 0.60, 0.21, -0.02, s)
  if (motion == "follow") move(0.61, -0.20, 0.85, 0.575, 0.23, 0.53, 0, 0, 0.45 + 0.55 * s)  # moving when it begins
  if (motion == "aim") move(0.48, -0.30, 0.30, 0.58, -0.05, 0.37, 0.02, 0.02, s)
  if (motion == "thread") move(0.58, -0.05, 0.37, 0.60, 0.03, 0.10, 0, 0, s)
  if (motion == "wipe") {
    p = 2 * pi * t / 1.2
    x = 0.55 + 0.060 * cos(p) + 0.006 * cos(2 * p + 0.7)
    y = 0.10 + 0.130 * sin(p) + 0.010 * sin(2 * p) + 0.004 * sin(3 * p + 1)
    z = 0.02 + 0.002 * cos(2 * p)
  }
}

function row(t,   c) {
  follow(t - rest)
  c = 0.00008  # [m] of each sinusoid: 0.1 mm RMS
  x += c * tremor(1, t) + 0.00003 * normal()
  y += c * tremor(2, t) + 0.00003 * normal()
  z += c * tremor(3, t) + 0.00003 * normal()
  tilt += 0.0008 * tremor(4, t)
  printf "%.5f,%.5f,%.5f,%.5f", t, x, y, z
  if (turns) printf ",%.6f,%.6f,%.6f,%.6f", 0, sin(tilt / 2), 0, cos(tilt / 2)
  printf "\n"
}

BEGIN {
  pi = atan2(0, -1)
  split("reach 1.2 11 pour 2.2 22 wipe 7.2 33 carry_lift 1.0 44 carry_place 1.0 55 wipe_approach 1.0 66 wipe_away 1.1 77 catch 1.4 88 follow 0.7 99 aim 1.0 111 thread 1.0 122", list, " ")
  for (i = 1; i in list; i += 3)
    if (list[i] == motion) { duration = list[i + 1]; seed = list[i + 2] }
  turns = motion == "reach" || motion == "pour"
  rest = motion == "wipe" ? 0 : 0.1  # [s] of stillness before and after
  for (i = 0; i < 10; i++) uniform()
  start_tremor()
  print "time,x,y,z" (turns ? ",qx,qy,qz,qw" : "")
  last = int((duration + 2 * rest) * 120 + 0.5)
  for (i = 0; i <= last; i++) {
    t = i / 120 + (i > 0 && i < last ? 0.0008 * (uniform() - 0.5) : 0)
    row(t)
  }
}
