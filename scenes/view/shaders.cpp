#include "scenes/view/shaders.hpp"

namespace seam {

const char* const vertex_shader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 direction;
uniform mat4 X_world_mesh, view;
uniform mat3 turn;
out vec3 at, normal, local;
void main() {
  local = position;
  at = (X_world_mesh * vec4(position, 1)).xyz;
  normal = turn * direction;
  gl_Position = view * vec4(at, 1);
})";

const char* const depth_shader = R"(#version 330 core
void main() {})";

const char* const surface_shader = R"(#version 330 core
in vec3 at, normal, local;
out vec4 seen;
uniform vec4 colour;      // not premultiplied
uniform vec4 above;       // colour of what is higher than `limit` in the mesh's frame
uniform float limit;
uniform int finish;       // 0 painted, 1 metal, 2 glass, 3 floor, 4 shines by itself
uniform vec3 eye, to_light, background;
uniform sampler2DShadow shadow[2];  // from the light, and from the sky
uniform mat4 shadow_view[2];
uniform float metres;     // across a shadow map
uniform vec2 floor_at;    // middle of the floor
uniform float floor_radius;

const float golden = 2.39996323;

// Share of a disc around a point that sees a light: points on a spiral from its rim inwards, few of them where all see the
// same.
float lit(int light, float radius, float bias) {
  vec3 p = (shadow_view[light] * vec4(at + normalize(normal) * bias, 1)).xyz * 0.5 + 0.5;
  if (any(lessThan(p, vec3(0))) || any(greaterThan(p, vec3(1)))) return 1.0;
  float sum = 0.0;
  for (int i = 0; i < 32; ++i) {
    float r = sqrt((31.5 - i) / 32.0) * radius / metres;
    vec2 q = p.xy + r * vec2(cos(i * golden), sin(i * golden));
    sum += light == 0 ? texture(shadow[0], vec3(q, p.z)) : texture(shadow[1], vec3(q, p.z));
    if (i == 11 && (sum == 0.0 || sum == 12.0)) return sum / 12.0;
  }
  return sum / 32.0;
}

vec3 sky(vec3 d) {
  return mix(vec3(0.50, 0.48, 0.46), vec3(1.0, 1.02, 1.06), smoothstep(-0.6, 0.8, d.z));
}

float line(vec2 p, float spacing, float width) {
  vec2 q = abs(fract(p / spacing + 0.5) - 0.5) * spacing;
  vec2 smear = fwidth(p);
  vec2 ink = clamp((width + 0.5 * smear - q) / smear, 0.0, 1.0) * min(vec2(1), 2.0 * width / smear);
  return max(ink.x, ink.y);
}

void main() {
  vec3 n = normalize(gl_FrontFacing ? normal : -normal);
  vec3 v = normalize(eye - at);
  vec3 base = mix(colour.rgb, above.rgb, above.a * smoothstep(limit - 2e-4, limit + 2e-4, local.z));
  if (finish == 4) {
    seen = vec4(base * (0.75 + 0.25 * max(dot(n, v), 0.0)), 1);
    return;
  }
  vec3 half_way = normalize(to_light + v);
  float facing = max(dot(n, v), 0.0);
  float fresnel = pow(1.0 - facing, 5.0);
  if (finish == 2) {
    float edge = pow(1.0 - facing, 2.5);
    float opacity = 0.025 + 0.7 * edge;
    float glint = pow(max(dot(n, half_way), 0.0), 200.0);
    seen = vec4(mix(vec3(0.6, 0.8, 0.9), vec3(0.12, 0.22, 0.32), edge) * opacity + glint, opacity);
    return;
  }
  float key = max(dot(n, to_light), 0.0);
  float shade = key > 0.0 ? lit(0, 0.012, 0.004) : 0.0;
  float open = mix(1.0, lit(1, 0.10, 0.015), 0.55);
  if (finish == 3) {
    float far = smoothstep(0.35, 1.0, distance(at.xy, floor_at) / floor_radius);
    float ink = max(0.16 * line(at.xy, 0.1, 0.0007), 0.30 * line(at.xy, 0.5, 0.0014));
    float light = (0.58 + 0.42 * shade) * mix(0.72, 1.0, (open - 0.45) / 0.55);
    seen = vec4(mix(base * light * (1.0 - ink), background, far), 1);
    return;
  }
  float metal = finish == 1 ? 1.0 : 0.0;
  vec3 mirror = mix(vec3(0.04), base, 0.8 * metal);
  vec3 diffuse = base * (1.0 - 0.55 * metal);
  vec3 reflected = sky(reflect(-v, n)) * (mirror + (1.0 - mirror) * fresnel * 0.5) * open;
  float gloss = finish == 1 ? 60.0 : 90.0;
  float glint = pow(max(dot(n, half_way), 0.0), gloss) * (gloss + 8.0) / 25.0;
  vec3 light = diffuse * (0.62 * key * shade + 0.52 * sky(n) * open)
             + reflected * mix(0.8, 0.7, metal) + mirror * glint * shade * 0.8;
  seen = vec4(light, 1);
})";

}  // namespace seam
