// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vegetation_sim::view {

// GLSL 1.20 (HEAD): what software rasterisers and OGRE 1.9 to 1.12 have. Light is computed per
// vertex. Vertex alpha: part of the sun that arrives; third texture coordinate: part of the sky.

constexpr const char* HEAD = "#version 120\n";
constexpr const char* LAYERED_HEAD = "#version 120\n#define LAYERED\n";
constexpr const char* FADING_HEAD = "#version 120\n#define FADING\n#define NEAR\n";
constexpr const char* NEAR_HEAD = "#version 120\n#define NEAR\n";

// LAYERED draws the leaves of one layer, selected by their anchors, opaque on nothing.
// Meshes of two levels of a tree fade into one another pixel by pixel, without any order: what
// comes shows where a pattern is below the part that shows, what goes where it is not.
// NEAR omits in the same way triangles near the eye that are seen almost on edge, as streaks.
constexpr const char* PLANT_VERTEX = R"(uniform mat4 world_view_projection;
uniform vec4 eye;           // in the object's frame
uniform vec4 to_sun;        // in the object's frame
uniform vec4 sun, zenith_light, ground_light;
uniform vec4 haze;          // start, 1 / length, most
uniform vec4 leaf;          // light that wraps around, shines through; sky and sun inside crowns
varying vec4 light;         // w: haze
varying vec2 place;
#ifdef FADING
uniform vec4 fade_clock;
varying float shown;  // part of what comes; of what goes less 1
#endif
#ifdef NEAR
uniform vec4 edges;  // sine of the angle to the view at which they begin to go; near, 1 / length
varying vec4 ray;    // from the eye; w: this sine, less far away
#endif
#ifdef LAYERED  // eye and sun are in the scene's frame
uniform mat4 world;
uniform vec4 depth_axis;  // direction; depth of the origin
uniform vec4 depths;      // begin and end of the layer
#endif
void main() {
  gl_Position = world_view_projection * gl_Vertex;
#ifdef LAYERED
  vec3 anchor = (world * vec4(gl_MultiTexCoord2.xyz, 1.0)).xyz;
  float depth = dot(depth_axis.xyz, anchor) + depth_axis.w;
  if (depth < depths.x || depth >= depths.y) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  vec3 at = (world * gl_Vertex).xyz;
  vec3 normal = normalize((world * vec4(gl_Normal, 0.0)).xyz);
#else
  vec3 at = gl_Vertex.xyz;
  vec3 normal = gl_Normal;
#endif
#ifdef FADING
  float since = gl_MultiTexCoord1.x;
  float part = clamp(fade_clock.x - abs(since), 0.0, 1.0);
  shown = since == 0.0 ? 1.0 : since > 0.0 ? part : part - 1.0;
#endif
  vec3 view = at - eye.xyz;
  float far = length(view);
#ifdef NEAR
  ray = vec4(view, edges.x * clamp(1.0 - (far - edges.y) * edges.z, 0.0, 1.0));
#endif
  float facing = (dot(normal, to_sun.xyz) + leaf.x) / (1.0 + leaf.x);
  float against = max(dot(view / far, to_sun.xyz), 0.0);
  float through = leaf.y * (0.25 + against * against * against);
  // Leaves in shade get light that other leaves have scattered.
  float reached = gl_Color.a * (max(facing, 0.0) + through) + (1.0 - gl_Color.a) * leaf.w;
  vec3 direct = sun.rgb * reached;
  vec3 around = mix(ground_light.rgb, zenith_light.rgb, 0.5 + 0.5 * normal.z);
  float f = clamp((far - haze.x) * haze.y, 0.0, 1.0);
  light.a = haze.z * f * (2.0 - f);
  vec3 lit = gl_Color.rgb * (direct + around * (leaf.z + (1.0 - leaf.z) * gl_MultiTexCoord0.z));
  // Bright saturated colours become paler and grow less, as on film, before a channel is cut off.
  float most = max(lit.r, max(lit.g, lit.b)), least = min(lit.r, min(lit.g, lit.b));
  float over = max(most - 0.5, 0.0) * (most - least) / max(most, 0.01);
  lit = mix(lit, vec3(dot(lit, vec3(0.3, 0.6, 0.1))), min(0.45 * over, 0.25)) / (1.0 + 0.75 * over);
  light.rgb = lit * (1.0 - light.a);
  place = gl_MultiTexCoord0.xy;
}
)";

constexpr const char* PLANT_FRAGMENT = R"(uniform sampler2D picture;
uniform vec4 haze_colour;
varying vec4 light;
varying vec2 place;
#ifdef FADING
varying float shown;
#endif
#ifdef NEAR
varying vec4 ray;
#endif
void main() {
#ifdef NEAR
  float pattern = fract(dot(floor(gl_FragCoord.xy), vec2(0.7548777, 0.5698403)));
  vec3 normal = cross(dFdx(ray.xyz), dFdy(ray.xyz));
  float across = dot(normal, ray.xyz), least = ray.w * (0.4 + 0.6 * pattern);
  if (across * across < least * least * dot(normal, normal) * dot(ray.xyz, ray.xyz)) discard;
#endif
#ifdef FADING
  if (shown > 0.0 ? pattern >= shown : pattern < shown + 1.0) discard;
#endif
  vec4 paint = texture2D(picture, place);
#ifdef LAYERED
  if (paint.a < 0.5) discard;
  paint.a = 1.0;
#endif
  gl_FragColor = vec4(light.rgb * paint.rgb + haze_colour.rgb * light.a, paint.a);
}
)";

// The picture of a layer on its grid. The picture has its light in it, and its colours are
// multiplied by their alpha. Texture coordinates are homogeneous.
constexpr const char* LAYER_VERTEX = R"(uniform mat4 world_view_projection;
varying vec3 place;
void main() {
  gl_Position = world_view_projection * gl_Vertex;
  place = gl_MultiTexCoord0.xyz;
}
)";

constexpr const char* LAYER_FRAGMENT = R"(uniform sampler2D picture;
uniform vec4 shown;  // part of the picture that shows
varying vec3 place;
void main() {
  vec4 paint = texture2DProj(picture, place);
  if (paint.a < 0.4) discard;
  gl_FragColor = paint * shown.x;
}
)";

// The ground's colours have their light in them. The second picture is its detail, mean one half:
// colours of litter for brown ground, alpha of blades for green ground. Near the eye, where plants
// are drawn on it, the picture's alpha is the light that they leave.
constexpr const char* GROUND_VERTEX = R"(uniform mat4 world_view_projection;
uniform vec4 eye;
uniform vec4 haze;
varying vec4 light;
varying vec4 place;
varying vec3 view;
void main() {
  gl_Position = world_view_projection * gl_Vertex;
  view = gl_Vertex.xyz - eye.xyz;
  float f = clamp((length(view) - haze.x) * haze.y, 0.0, 1.0);
  light = vec4(gl_Color.rgb, haze.z * f * (2.0 - f));
  place = vec4(gl_MultiTexCoord0.xy, gl_Vertex.xy * 0.31);
}
)";

constexpr const char* GROUND_FRAGMENT = R"(uniform sampler2D picture;
uniform sampler2D grain;
uniform vec4 haze_colour;
uniform vec4 under;  // one over the square of how far it darkens [1/m2]
varying vec4 light;
varying vec4 place;
varying vec3 view;
void main() {
  vec4 ground = texture2D(picture, place.xy);
  float far = min(dot(view, view) * under.x, 1.0);
  vec3 paint = ground.rgb * light.rgb * mix(ground.a, 1.0, far);
  // Far away the repeating detail would show as rows.
  vec4 fine = mix(vec4(0.5), texture2D(grain, place.zw), 1.0 / (1.0 + 0.0003 * dot(view, view)));
  float sum = paint.r + paint.g + paint.b;
  float green = clamp((18.0 * paint.g - 6.36 * sum) / (sum + 0.01), 0.0, 1.0);
  paint *= 2.0 * mix(fine.rgb, fine.aaa, green);
  gl_FragColor = vec4(mix(paint, haze_colour.rgb, light.a), 1.0);
}
)";

// Grass: colours have their light in them. Vertex alpha: part of the picture's blades that show,
// those whose own alpha is above the rest.
constexpr const char* GRASS_VERTEX = R"(uniform mat4 world_view_projection;
uniform vec4 eye;
uniform vec4 haze;
varying vec4 light;
varying vec3 place;
void main() {
  gl_Position = world_view_projection * gl_Vertex;
  float f = clamp((length(gl_Vertex.xyz - eye.xyz) - haze.x) * haze.y, 0.0, 1.0);
  light = vec4(gl_Color.rgb, haze.z * f * (2.0 - f));
  place = vec3(gl_MultiTexCoord0.xy, gl_Color.a);
}
)";

constexpr const char* BLADE_FRAGMENT = R"(uniform vec4 haze_colour;
varying vec4 light;
void main() {
  gl_FragColor = vec4(mix(light.rgb, haze_colour.rgb, light.a), 1.0);
}
)";

constexpr const char* STRIP_FRAGMENT = R"(uniform sampler2D picture;
uniform vec4 haze_colour;
varying vec4 light;
varying vec3 place;
void main() {
  vec4 paint = texture2D(picture, place.xy);
  if (paint.a <= 1.0 - place.z) discard;
  gl_FragColor = vec4(mix(light.rgb * paint.rgb * 1.3, haze_colour.rgb, light.a), 1.0);
}
)";

constexpr const char* SHADOW_FRAGMENT = R"(uniform sampler2D picture;
uniform vec4 haze_colour;
varying vec4 light;
varying vec3 place;
void main() {
  gl_FragColor = vec4(mix(light.rgb, haze_colour.rgb, light.a),
                      texture2D(picture, place.xy).a * place.z);
}
)";

}  // namespace vegetation_sim::view
