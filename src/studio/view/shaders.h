/// @file shaders.h
/// The programs of the viewport but that of surfaces, GLSL 3.30.
#pragma once

/// Wind as a preview: what is higher gives way farther, in gusts that run over the ground. `gust`
/// is which way and how far, parts of the height; the time in seconds; the height, m, 0 for no
/// wind.
#define STUDIO_SWAY                                                                                \
    "uniform vec4 gust;\n"                                                                         \
    "vec3 sway(vec3 p) {\n"                                                                        \
    "    if (gust.w <= 0.0) return vec3(0.0);\n"                                                   \
    "    float h = clamp(p.z / gust.w, 0.0, 1.5), t = gust.z;\n"                                   \
    "    float run = dot(p.xy, vec2(2.1, 1.7)) / gust.w;\n"                                        \
    "    vec2 d = gust.xy * gust.w * h * h * (0.55 + 0.3 * sin(1.3 * t - run)\n"                   \
    "                                         + 0.15 * sin(3.1 * t - 2.3 * run + 4.0 * h));\n"     \
    "    return vec3(d, -0.5 * dot(d, d) / max(p.z, 0.001));\n"                                    \
    "}\n"

/// Vertices of tubes and of instanced leaves; what is not instanced has a constant placement.
#define STUDIO_PLACE                                                                               \
    "#version 330 core\n"                                                                          \
    "layout(location=0) in vec3 position;\n"                                                       \
    "layout(location=1) in vec3 normal;\n"                                                         \
    "layout(location=2) in vec2 uv;\n"                                                             \
    "layout(location=3) in vec4 placement;\n" /* where, and how large */                           \
    "layout(location=4) in vec4 turn;\n"                                                           \
    "uniform mat4 model;\n"                                                                        \
    "uniform mat4 clip;\n"                                                                         \
    "uniform float enlarge; uniform bool is_leaf, is_still;\n" STUDIO_SWAY                         \
    "vec3 turned(vec3 v) { return v + 2.0 * cross(turn.xyz, cross(turn.xyz, v) + turn.w * v); }\n" \
    "vec4 placed() {\n"                                                                            \
    "    vec4 at = model * vec4(turned(position) * placement.w * enlarge + placement.xyz, 1.0);\n" \
    "    if (gust.w <= 0.0 || is_still) return at;\n"                                              \
    "    vec3 foot = is_leaf ? (model * vec4(placement.xyz, 1.0)).xyz : at.xyz;\n"                 \
    "    vec3 blade = at.xyz - foot;\n"                                                            \
    "    float beat = sin(7.0 * gust.z + dot(foot, vec3(127.0, 83.0, 59.0)) / gust.w);\n"          \
    "    blade += cross(vec3(-gust.y, gust.x, 0.0) * 4.0 * beat, blade);\n"                        \
    "    return vec4(foot + blade + sway(foot), 1.0);\n"                                           \
    "}\n"

static const char studio_shadow_vertex[] =
    STUDIO_PLACE "out vec2 tile; void main() { tile = uv; gl_Position = clip * placed(); }\n";
static const char studio_shadow_fragment[] =
    "#version 330 core\n"
    "in vec2 tile; uniform sampler2D picture; uniform float cutoff;\n"
    "uniform bool has_picture, is_blade;\n"
    "void main() { if (has_picture && is_blade && texture(picture, tile).a < cutoff) discard; }\n";

/// The floor: a grid that fades with distance, with the shadow of what stands on it.
static const char studio_floor_vertex[] =
    "#version 330 core\n"
    "uniform mat4 clip; uniform float extent; uniform vec2 centre; out vec2 at;\n"
    "void main() {\n"
    "    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;\n"
    "    at = centre + corner * extent; gl_Position = clip * vec4(at, 0.0, 1.0);\n"
    "}\n";
static const char studio_floor_fragment[] =
    "#version 330 core\n"
    "in vec2 at; uniform vec2 centre; uniform float extent, cell; uniform bool has_grid; uniform "
    "vec3 ground;\n"
    "uniform sampler2DShadow shadow; uniform mat4 to_shadow; uniform bool has_shadow, is_plain;\n"
    "layout(location=0) out vec4 colour;\n"
    "float lines(float size) {\n"
    "    vec2 p = at / size, d = fwidth(p) + 1e-6;\n"
    "    vec2 l = 1.0 - smoothstep(vec2(0.5), vec2(1.5), abs(p - round(p)) / d);\n"
    "    l *= clamp(1.3 - 4.0 * d, 0.0, 1.0); return max(l.x, l.y);\n" /* else they would shimmer */
    "}\n"
    "void main() {\n"
    "    float fade = 1.0 - smoothstep(0.25, 1.0, length(at - centre) / extent);\n"
    "    float dark = 0.0;\n"
    "    if (has_shadow) {\n"
    "        vec3 s = (to_shadow * vec4(at, 0.0, 1.0)).xyz * 0.5 + 0.5; float sum = 0.0;\n"
    "        vec2 texel = 1.0 / vec2(textureSize(shadow, 0));\n"
    "        int first = is_plain ? 4 : 0, end = is_plain ? 5 : 9;\n"
    "        for (int i = first; i < end; i++) {\n"
    "            vec2 o = vec2(i % 3 - 1, i / 3 - 1) * 1.3 * texel;\n"
    "            sum += texture(shadow, vec3(s.xy + o, s.z - 0.0008));\n"
    "        }\n"
    "        bool inside = all(greaterThan(s.xy, vec2(0.0))) && all(lessThan(s.xy, vec2(1.0)));\n"
    "        dark = inside ? 1.0 - sum / float(end - first) : 0.0;\n"
    "    }\n"
    "    float line = has_grid ? max(0.07 * lines(cell), 0.16 * lines(cell * 10.0)) : 0.0;\n"
    "    vec3 c = mix(ground, vec3(1.0), line) * (1.0 - 0.5 * dark);\n"
    "    colour = vec4(c, fade * 0.85);\n"
    "}\n";

/// The lines of the skeleton, by order; what is farther away is nearer to the backdrop. `haze` is
/// where that begins, and over how much, m.
static const char studio_line_vertex[] =
    "#version 330 core\n"
    "layout(location=0) in vec3 position; layout(location=1) in float order;\n"
    "uniform mat4 model, clip; uniform vec2 haze; uniform vec3 first, last, behind; out vec4 "
    "shown;\n" STUDIO_SWAY "void main() {\n"
    "    float t = clamp(order / 4.0, 0.0, 1.0);\n"
    "    vec4 at = model * vec4(position, 1.0);\n"
    "    gl_Position = clip * vec4(at.xyz + sway(at.xyz), 1.0);\n"
    "    float away = clamp((gl_Position.w - haze.x) / haze.y, 0.0, 1.0);\n"
    "    shown = vec4(mix(mix(first, last, t), behind, 0.85 * away * away), 1.0);\n"
    "}\n";
static const char studio_line_fragment[] =
    "#version 330 core\n"
    "in vec4 shown; layout(location=0) out vec4 colour; void main() { colour = shown; }\n";

/// A triangle that covers the picture.
static const char studio_whole_vertex[] = "#version 330 core\n"
                                          "out vec2 uv;\n"
                                          "void main() {\n"
                                          "    uv = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0; "
                                          "gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);\n"
                                          "}\n";
static const char studio_backdrop_fragment[] =
    "#version 330 core\n"
    "in vec2 uv; uniform vec3 above, below; layout(location=0) out vec4 colour;\n"
    "void main() {\n"
    "    float grain = fract(sin(dot(gl_FragCoord.xy, vec2(12.9898, 78.233))) * 43758.5453) - "
    "0.5;\n"
    "    colour = vec4(mix(below, above, smoothstep(0.0, 1.0, uv.y)) + grain / 255.0, 1.0);\n"
    "}\n";

/// Shows a drawn picture; with ambient occlusion from its depths: near neighbours in front darken.
/// They are taken in pairs on both sides, whose mean is the depth here where the surface is flat.
static const char studio_show_fragment[] =
    "#version 330 core\n"
    "in vec2 uv; uniform sampler2D drawn, depths; uniform vec2 planes; uniform float reach;\n"
    "uniform bool has_occlusion; layout(location=0) out vec4 colour;\n"
    "float far_of(vec2 p) {\n"
    "    float d = texture(depths, p).r * 2.0 - 1.0;\n"
    "    return 2.0 * planes.x * planes.y / (planes.x + planes.y - d * (planes.y - planes.x));\n"
    "}\n"
    "void main() {\n"
    "    vec3 c = texture(drawn, uv).rgb;\n"
    "    float here = far_of(uv);\n"
    "    if (has_occlusion && here < planes.y * 0.98) {\n"
    "        vec2 size = vec2(textureSize(drawn, 0)); float radius = reach * size.y / here;\n"
    "        float turn = fract(sin(dot(gl_FragCoord.xy, vec2(12.9898, 78.233))) * 43758.5453);\n"
    "        float world = reach * 2.2, hidden = 0.0;\n"
    "        for (int i = 0; i < 9; i++) {\n"
    "            float a = (float(i) + turn) * 2.39996, r = sqrt((float(i) + 0.5) / 9.0);\n"
    "            vec2 o = vec2(cos(a), sin(a)) * r * radius / size;\n"
    "            float flat_here = 2.0 / (1.0 / far_of(uv + o) + 1.0 / far_of(uv - o));\n"
    "            float d = 1.6 * (here - flat_here) / world;\n"
    "            hidden += smoothstep(0.02, 0.35, d) * (1.0 - smoothstep(1.0, 3.0, d));\n"
    "        }\n"
    "        c *= 1.0 - 0.34 * hidden / 9.0;\n"
    "    }\n"
    "    colour = vec4(c, texture(drawn, uv).a);\n" // 1 where there is a backdrop
    "}\n";
