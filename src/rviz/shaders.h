// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vegetation_sim::view {

// GLSL 1.20: what software rasterisers and OGRE 1.9 to 1.12 have. Light is computed per vertex.
// Vertex alpha: part of the sun that arrives; third texture coordinate: part of the sky.

constexpr const char* PLANT_VERTEX = R"(#version 120
uniform mat4 world_view_projection;
uniform vec4 eye;           // in the object's frame
uniform vec4 to_sun;        // in the object's frame
uniform vec4 sun, zenith_light, ground_light;
uniform vec4 haze;          // start, 1 / length, most
uniform vec4 leaf;          // light that wraps around, shines through, is scattered inside
varying vec4 light;         // w: haze
varying vec2 place;
void main() {
  gl_Position = world_view_projection * gl_Vertex;
  vec3 view = gl_Vertex.xyz - eye.xyz;
  float far = length(view);
  float facing = (dot(gl_Normal, to_sun.xyz) + leaf.x) / (1.0 + leaf.x);
  float against = max(dot(view / far, to_sun.xyz), 0.0);
  float through = leaf.y * (0.25 + against * against * against);
  vec3 direct = sun.rgb * gl_Color.a * (max(facing, 0.0) + through);
  vec3 around = mix(ground_light.rgb, zenith_light.rgb, 0.5 + 0.5 * gl_Normal.z);
  light.rgb = gl_Color.rgb * (direct + around * (leaf.z + (1.0 - leaf.z) * gl_MultiTexCoord0.z));
  float f = clamp((far - haze.x) * haze.y, 0.0, 1.0);
  light.a = haze.z * f * (2.0 - f);
  place = gl_MultiTexCoord0.xy;
}
)";

constexpr const char* PLANT_FRAGMENT = R"(#version 120
uniform sampler2D picture;
uniform vec4 haze_colour;
varying vec4 light;
varying vec2 place;
void main() {
  vec4 paint = texture2D(picture, place);
  gl_FragColor = vec4(mix(light.rgb * paint.rgb, haze_colour.rgb, light.a), paint.a);
}
)";

// The ground's colours have their light in them; the second picture is its grain, mean one half.
constexpr const char* GROUND_VERTEX = R"(#version 120
uniform mat4 world_view_projection;
uniform vec4 eye;
uniform vec4 haze;
varying vec4 light;
varying vec4 place;
void main() {
  gl_Position = world_view_projection * gl_Vertex;
  float f = clamp((length(gl_Vertex.xyz - eye.xyz) - haze.x) * haze.y, 0.0, 1.0);
  light = vec4(gl_Color.rgb, haze.z * f * (2.0 - f));
  place = vec4(gl_MultiTexCoord0.xy, gl_Vertex.xy * 0.31);
}
)";

constexpr const char* GROUND_FRAGMENT = R"(#version 120
uniform sampler2D picture;
uniform sampler2D grain;
uniform vec4 haze_colour;
varying vec4 light;
varying vec4 place;
void main() {
  vec3 paint = texture2D(picture, place.xy).rgb * light.rgb;
  paint *= 2.0 * texture2D(grain, place.zw).rgb;
  gl_FragColor = vec4(mix(paint, haze_colour.rgb, light.a), 1.0);
}
)";

}  // namespace vegetation_sim::view
