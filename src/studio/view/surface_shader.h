/// @file surface_shader.h
/// How surfaces of plants are shown, GLSL 3.30: what the path tracer's materials do (render/bsdf.h,
/// render/look.h) with the light of frond/shading.h, so that both show one plant alike.
#pragma once

#include "studio/view/shaders.h"

#include "render/agx.h"

// The text of what a macro stands for.
#define STUDIO_TEXT_OF(...) #__VA_ARGS__
#define STUDIO_TEXT(...) STUDIO_TEXT_OF(__VA_ARGS__)

static const char studio_surface_vertex[] =
    STUDIO_PLACE "out vec3 at; out vec3 facing; out vec2 tile;\n"
                 "void main() {\n"
                 "    vec4 world = placed();\n"
                 "    at = world.xyz; facing = mat3(model) * turned(normal); tile = uv;\n"
                 "    gl_Position = clip * world;\n"
                 "}\n";

/// Light through the tone curve to what a screen takes.
#define STUDIO_TONE                                                                                                                   \
    "vec3 tone(vec3 light) {\n"                                                                                                       \
    "    const float low = " STUDIO_TEXT(FR_AGX_LOWEST) ", high = " STUDIO_TEXT(                                                      \
        FR_AGX_HIGHEST) ";\n"                                                                                                         \
                        "    light = transpose(mat3(" STUDIO_TEXT(                                                                    \
                            FR_AGX_INSET) ")) * light;\n"                                                                             \
                                          "    vec3 x = clamp((log2(max(light, 1e-10)) - low) / "                                     \
                                          "(high - low), 0.0, 1.0);\n"                                                                \
                                          "    vec3 x2 = x * x, x4 = x2 * x2;\n"                                                      \
                                          "    x = " STUDIO_TEXT(FR_AGX_CURVE(                                                        \
                                              x, x2,                                                                                  \
                                              x4)) ";\n"                                                                              \
                                                   "    x = pow(max(x, 0.0), vec3(" STUDIO_TEXT(                                      \
                                                       FR_AGX_POWER) "));\n"                                                          \
                                                                     "    x = mix(vec3(dot(x, "                                       \
                                                                     "luminance)), "                                                  \
                                                                     "x, " STUDIO_TEXT(                                               \
                                                                         FR_AGX_SATURATION) ");\n"                                    \
                                                                                            "    "                                    \
                                                                                            "retu"                                    \
                                                                                            "rn "                                     \
                                                                                            "clam"                                    \
                                                                                            "p("                                      \
                                                                                            "tran"                                    \
                                                                                            "spos"                                    \
                                                                                            "e("                                      \
                                                                                            "mat3"                                    \
                                                                                            "(" STUDIO_TEXT(                          \
                                                                                                FR_AGX_OUTSET) ")) * x, 0.0, 1.0);\n" \
                                                                                                               "}\n"

/// The sun, sky and ground from all sides, and lamps with their shadows (view/lamp_maps.h); those
/// of large lamps are soft.
#define STUDIO_LIGHT                                                                               \
    "uniform vec3 sky[9], sun, sun_colour, eye;\n"                                                 \
    "uniform int lamp_count;\n"                                                                    \
    "uniform vec4 lamp_at[8], lamp_axis[8];\n" /* and size; cosine of the cone, above 1: an area   \
                                                */                                                 \
    "uniform vec3 lamp_colour[8];\n"                                                               \
    "uniform sampler2DShadow lamp_maps; uniform mat4 to_lamp[12]; uniform vec3 lamp_map[8];\n"     \
    "float lamp_lit(int i, vec3 way, vec3 n, float far) {\n"                                       \
    "    if (lamp_map[i].y == 0.0) return 1.0;\n"                                                  \
    "    vec3 a = abs(way); int map = int(lamp_map[i].x);\n"                                       \
    "    if (lamp_map[i].y > 1.0) {\n"                                                             \
    "        map += a.x >= max(a.y, a.z) ? (way.x < 0.0 ? 0 : 1)\n"                                \
    "               : a.y >= a.z ? (way.y < 0.0 ? 2 : 3) : (way.z < 0.0 ? 4 : 5);\n"               \
    "    }\n"                                                                                      \
    "    vec4 p = to_lamp[map] * vec4(at + (0.004 * way + 0.012 * n) * far, 1.0);\n"               \
    "    vec3 s = p.xyz / max(p.w, 1e-6) * 0.5 + 0.5; vec2 cell = vec2(map % 4, map / 4);\n"       \
    "    if (any(lessThan(s.xy, vec2(0.0))) || any(greaterThan(s.xy, vec2(1.0)))) return 1.0;\n"   \
    "    float wide = clamp(lamp_map[i].z / far, 0.0025, 0.008), sum = 0.0;\n"                     \
    "    float turn = 6.2832 * fract(sin(dot(at, vec3(127.1, 311.7, 74.7))) * 43758.5453);\n"      \
    "    for (int k = 0; k < 4; k++) {\n"                                                          \
    "        vec2 o = vec2(cos(turn), sin(turn)) * wide * sqrt((float(k) + 0.5) / 4.0);\n"         \
    "        vec2 q = (cell + clamp(s.xy + o, 0.001, 0.999)) / vec2(4.0, 3.0);\n"                  \
    "        sum += texture(lamp_maps, vec3(q, s.z)); turn += 2.39996;\n"                          \
    "    }\n"                                                                                      \
    "    return sum * 0.25;\n"                                                                     \
    "}\n"                                                                                          \
    "vec3 from_sky(vec3 n) {\n"                                                                    \
    "    return max(sky[0] + sky[1] * n.y + sky[2] * n.z + sky[3] * n.x + sky[4] * n.x * n.y\n"    \
    "               + sky[5] * n.y * n.z + sky[6] * (3.0 * n.z * n.z - 1.0)\n"                     \
    "               + sky[7] * n.x * n.z + sky[8] * (n.x * n.x - n.y * n.y), 0.0);\n"              \
    "}\n"

/// How much of the sun a point sees: of four places about it, or of itself.
#define STUDIO_LIT                                                                                 \
    "float lit() {\n"                                                                              \
    "    if (!has_shadow) return 1.0;\n"                                                           \
    "    vec4 p = to_shadow * vec4(at, 1.0); vec3 s = p.xyz * 0.5 + 0.5;\n"                        \
    "    if (any(lessThan(s, vec3(0.0))) || any(greaterThan(s, vec3(1.0)))) return 1.0;\n"         \
    "    float bias = 0.0012; vec2 texel = 1.0 / vec2(textureSize(shadow, 0)); float sum = 0.0;\n" \
    "    for (int i = 0; i < 4; i++) {\n"                                                          \
    "        vec2 o = (vec2(i & 1, i >> 1) - 0.5) * 1.6 * texel;\n"                                \
    "        sum += texture(shadow, vec3(s.xy + o, s.z - bias));\n"                                \
    "    }\n"                                                                                      \
    "    return sum * 0.25;\n"                                                                     \
    "}\n"
#define STUDIO_LIT_ONCE                                                                            \
    "float lit() {\n"                                                                              \
    "    if (!has_shadow) return 1.0;\n"                                                           \
    "    vec3 s = (to_shadow * vec4(at, 1.0)).xyz * 0.5 + 0.5;\n"                                  \
    "    bool is_out = any(lessThan(s, vec3(0.0))) || any(greaterThan(s, vec3(1.0)));\n"           \
    "    return is_out ? 1.0 : texture(shadow, vec3(s.xy, s.z - 0.0012));\n"                       \
    "}\n"

/// What a surface throws back or lets through; see render/bsdf.h.
#define STUDIO_SCATTER                                                                             \
    "struct Skin { vec3 matt, through, n, v; float coat, width, a, b, out_cosine, out_coated; "    \
    "};\n"                                                                                         \
    "float fresnel(float coat, float cosine) {\n"                                                  \
    "    float m = 1.0 - clamp(cosine, 0.0, 1.0), m2 = m * m;\n"                                   \
    "    return coat + (1.0 - coat) * m2 * m2 * m;\n"                                              \
    "}\n"                                                                                          \
    "float coated(float coat, float cosine) {\n"                                                   \
    "    return coat > 0.0 ? 1.0 - fresnel(coat, cosine) : 1.0;\n"                                 \
    "}\n"                                                                                          \
    "float hiding(float width, float cosine) {\n"                                                  \
    "    float square = max(cosine * cosine, 1e-6);\n"                                             \
    "    return 0.5 * (sqrt(1.0 + width * width * max(0.0, 1.0 - square) / square) - 1.0);\n"      \
    "}\n"                                                                                          \
    "vec3 thrown(Skin s, vec3 way, vec3 light) {\n"                                                \
    "    float c = dot(s.n, way);\n"                                                               \
    "    float matt = s.out_coated * coated(s.coat, abs(c)) * abs(c);\n"                           \
    "    if (c <= 0.0) return s.through * matt * light;\n"                                         \
    "    float across = dot(s.v, way) - s.out_cosine * c;\n"                                       \
    "    matt *= s.a + s.b * max(across, 0.0) / max(max(s.out_cosine, c), 1e-4);\n"                \
    "    vec3 sum = s.matt * matt;\n"                                                              \
    "    if (s.coat > 0.0) {\n"                                                                    \
    "        vec3 h = normalize(s.v + way); float w = s.width * s.width, n = dot(s.n, h);\n"       \
    "        float base = n * n * (w - 1.0) + 1.0;\n"                                              \
    "        float hidden = 1.0 + hiding(s.width, s.out_cosine) + hiding(s.width, c);\n"           \
    "        sum += fresnel(s.coat, dot(h, way)) * w / (base * base * 4.0 * s.out_cosine * "       \
    "hidden);\n"                                                                                   \
    "    }\n"                                                                                      \
    "    return sum * light;\n"                                                                    \
    "}\n"                                                                                          \
    "vec3 from_lamps(Skin s) {\n"                                                                  \
    "    vec3 sum = vec3(0.0);\n"                                                                  \
    "    for (int i = 0; i < lamp_count; i++) {\n"                                                 \
    "        vec3 way = lamp_at[i].xyz - at; float square = dot(way, way);\n"                      \
    "        way *= inversesqrt(max(square, 1e-12));\n"                                            \
    "        float before = -dot(lamp_axis[i].xyz, way), edge = lamp_axis[i].w;\n"                 \
    "        float part = edge > 1.0 ? max(before, 0.0) : smoothstep(edge - 0.01, edge + 0.01, "   \
    "before);\n"                                                                                   \
    "        part = edge <= -1.0 ? 1.0 : part;\n"                                                  \
    "        float near = lamp_at[i].w * lamp_at[i].w;\n"                                          \
    "        sum += thrown(s, way, lamp_colour[i] * part * lamp_lit(i, way, dot(s.n, way) < 0.0 "  \
    "? -s.n : s.n, sqrt(square)) / "                                                               \
    "max(square, near));\n"                                                                        \
    "    }\n"                                                                                      \
    "    return sum;\n"                                                                            \
    "}\n"

/// All light that a surface throws to the eye, by how much of the sun it sees.
#define STUDIO_ALL_LIGHT                                                                           \
    "vec3 all_light(Skin s, vec3 base, float open) {\n"                                             \
    "    vec3 direct = thrown(s, sun, sun_colour * open) + from_lamps(s);\n"                        \
    "    vec3 bounce = from_sky(reflect(-s.v, s.n));\n"                                             \
    "    vec3 soft = mirror * base * bounce;\n" /* 0.92: what a coat takes on the way in */         \
    "    soft += s.out_coated * (s.coat > 0.0 ? 0.92 : 1.0) *\n"                                    \
    "            (s.matt * from_sky(s.n) + s.through * from_sky(-s.n));\n"                          \
    "    float shine = s.coat > 0.0 ? fresnel(s.coat, s.out_cosine) * (1.0 - 0.6 * s.width) : "     \
    "0.0;\n"                                                                                        \
    /* What stands around is darker than the sky; of a road or a wall one sees more than of */      \
    /* leaves within a crown. What hides the sun hides about half of the sky, too. */              \
    "    soft += shine * (is_blade ? open : 0.4 + 0.6 * open) * bounce;\n"                          \
    "    return direct + soft * (0.5 + 0.5 * open);\n"                                              \
    "}\n"

/// The normal, bent by its map in the frame of the texture coordinates as the path tracer does it,
/// on the side of the viewer.
#define STUDIO_NORMAL                                                                              \
    "vec3 normal_here(vec3 v) {\n"                                                                 \
    "    vec3 n = normalize(facing), p1 = dFdx(at), p2 = dFdy(at); vec2 t1 = dFdx(tile), t2 = "    \
    "dFdy(tile);\n"                                                                                \
    "    if (has_bumps && !is_wire) {\n"                                                           \
    "        float area = t1.x * t2.y - t2.x * t1.y;\n"                                            \
    "        vec3 u = (p1 * t2.y - p2 * t1.y) * sign(area); u -= n * dot(n, u);\n"                 \
    "        float size = dot(u, u);\n"                                                            \
    "        if (size > 0.0) {\n"                                                                  \
    "            u *= inversesqrt(size); vec3 m = texture(bumps, tile).rgb * 2.0 - 1.0;\n"         \
    "            vec3 up = cross(n, u) * ((area > 0.0) == gl_FrontFacing ? -1.0 : 1.0);\n"         \
    "            n = normalize(u * m.x * relief + up * m.y * relief + n * max(m.z, 0.05));\n"      \
    "        }\n"                                                                                  \
    "    }\n"                                                                                      \
    "    vec3 side = cross(p1, p2); side = dot(side, v) < 0.0 ? -side : side;\n"                   \
    "    if (is_wire ? dot(n, v) < 0.0 : is_blade ? dot(n, side) < 0.0 : !gl_FrontFacing) n = "    \
    "-n;\n"                                                                                        \
    "    float below = 0.02 - dot(n, v);\n"                                                        \
    "    return below > 0.0 ? normalize(n + v * below) : n;\n"                                     \
    "}\n"

/// What a surface of that colour and roughness is made of; its `v` and `n` are set.
#define STUDIO_SKIN                                                                                \
    "Skin skin_of(Skin s, vec3 base, float rough, bool is_back) {\n"                               \
    "    s.out_cosine = max(dot(s.n, s.v), 1e-4); s.a = 1.0; s.b = 0.0; s.through = vec3(0.0);\n"  \
    "    s.matt = base;\n"                                                                         \
    "    if (is_blade) {\n" /* light through a blade is yellower, its lower side paler */          \
    "        float green = clamp((2.0 * base.g - base.r - base.b) / max(base.g, 1e-4), 0.0, "      \
    "1.0);\n"                                                                                      \
    "        s.through = min(mix(base, base * vec3(1.12, 1.25, 0.35), green), 1.0) * "             \
    "translucency;\n"                                                                              \
    "        if (is_back) {\n"                                                                     \
    "            s.matt = mix(base, vec3(dot(base, luminance)), 0.25 * green) * (1.0 + 0.25 * "    \
    "green);\n"                                                                                    \
    "            s.matt = min(s.matt, 1.0); rough = min(rough * 1.3, 1.0);\n"                      \
    "        }\n"                                                                                  \
    "        s.matt *= 1.0 - translucency;\n"                                                      \
    "    } else {\n"                                                                               \
    "        float q = 0.36 * rough * rough; s.a = 1.0 - 0.5 * q / (q + 0.33); s.b = 0.45 * q / "  \
    "(q + 0.09);\n"                                                                                \
    "    }\n"                                                                                      \
    "    float rest = (1.0 - mirror) * (1.0 - clear); s.matt *= rest; s.through *= rest;\n"        \
    "    s.coat = rough < 1.0 && rest >= 1.0 ? 0.04 : 0.0; s.width = max(rough * rough, "          \
    "0.05);\n"                                                                                     \
    "    s.out_coated = coated(s.coat, s.out_cosine);\n"                                           \
    "    return s;\n"                                                                              \
    "}\n"                                                                                          \
    /* What comes through clear glass, and its own light on top, in the colours of the screen. */  \
    /* Light adds up before the tone curve: a square root here, over a wall in the light. */       \
    "vec3 beyond_of(vec3 base) { return sqrt(max(base * (1.0 - mirror) * clear, 0.0)); }\n"        \
    "vec3 over(vec3 own, vec3 beyond) {\n"                                                         \
    "    vec3 grey = 0.7 * beyond; return sqrt(own * own + grey * grey) - grey;\n"                 \
    "}\n"

/// What light and surfaces are told by.
#define STUDIO_TOLD                                                                                \
    "uniform vec3 tint; uniform float cutoff, translucency, roughness, relief, mirror, clear;\n"   \
    "uniform bool has_picture, is_blade;\n"                                                        \
    "uniform sampler2D picture;\n"                                                                 \
    "uniform sampler2DShadow shadow; uniform mat4 to_shadow; uniform bool has_shadow;\n"           \
    "const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);\n"

static const char studio_surface_fragment[] =
    "#version 330 core\n"
    "in vec3 at; in vec3 facing; in vec2 tile;\n" STUDIO_TOLD
    "uniform bool has_bumps, has_gloss, is_wire;\n"
    "uniform sampler2D bumps, gloss;\n"
    "layout(location=0) out vec4 colour; layout(location=0, index=1) out vec4 beyond;\n" STUDIO_TONE
        STUDIO_LIGHT STUDIO_LIT STUDIO_SCATTER STUDIO_NORMAL STUDIO_ALL_LIGHT STUDIO_SKIN
    "vec3 base_here() {\n"
    "    if (!has_picture) return tint;\n"
    "    vec4 t = texture(picture, tile);\n"
    "    if (is_blade) {\n" /* smaller pictures of a leaf have softer edges: keep their area */
    "        vec2 d = tile * vec2(textureSize(picture, 0));\n"
    "        float level = max(0.0, 0.5 * log2(max(dot(dFdx(d), dFdx(d)), dot(dFdy(d), "
    "dFdy(d)))));\n"
    "        if (t.a * (1.0 + 0.25 * level) < cutoff) discard;\n"
    "    }\n"
    "    return t.rgb * tint;\n"
    "}\n"
    "void main() {\n"
    "    vec3 base = base_here();\n"
    "    Skin s; s.v = normalize(eye - at); s.n = normal_here(s.v);\n"
    "    float rough = has_gloss ? roughness * texture(gloss, tile).g : roughness;\n"
    "    s = skin_of(s, base, rough, !gl_FrontFacing);\n"
    "    beyond = vec4(beyond_of(base), 1.0);\n"
    "    colour = vec4(over(tone(all_light(s, base, lit())), beyond.rgb), 1.0);\n"
    "}\n";

/// The same with the light of vertices, for machines on which that of pixels takes too long while
/// the view moves: on a software renderer a fragment of a small triangle costs more than its
/// vertices. What a picture differs from its mean goes on top, as if the tone curve were a square
/// root.
#define STUDIO_PLAIN                                                                               \
    "flat out vec3 mean;\n" STUDIO_TOLD STUDIO_TONE STUDIO_LIGHT STUDIO_LIT_ONCE STUDIO_SCATTER    \
        STUDIO_ALL_LIGHT STUDIO_SKIN "Skin skin_here() {\n"                                        \
    "    vec4 world = placed(); at = world.xyz; tile = uv; gl_Position = clip * world;\n"          \
    "    mean = has_picture ? max(textureLod(picture, vec2(0.5), 16.0).rgb, 0.01) : vec3(1.0);\n"  \
    "    Skin s; s.v = normalize(eye - at); s.n = normalize(mat3(model) * turned(normal));\n"      \
    "    bool is_back = dot(s.n, s.v) < 0.0; s.n = is_back ? -s.n : s.n;\n"                        \
    "    return skin_of(s, mean * tint, roughness, is_back);\n"                                    \
    "}\n"
#define STUDIO_PAINT                                                                               \
    "in vec2 tile; flat in vec3 mean;\n"                                                           \
    "uniform bool has_picture, is_blade; uniform sampler2D picture; uniform float cutoff;\n"       \
    "layout(location=0) out vec4 colour;\n"                                                        \
    "vec4 painted(vec3 c) {\n"                                                                     \
    "    if (!has_picture) return vec4(c, 1.0);\n"                                                 \
    "    vec4 t = texture(picture, tile);\n"                                                       \
    "    if (is_blade && t.a < cutoff) discard;\n"                                                 \
    "    return vec4(c * sqrt(t.rgb / mean), 1.0);\n"                                              \
    "}\n"

static const char studio_plain_vertex[] =
    STUDIO_PLACE "vec3 at; out vec3 paint; out vec2 tile;\n" STUDIO_PLAIN "void main() {\n"
                 "    Skin s = skin_here(); paint = tone(all_light(s, mean * tint, lit()));\n"
                 "}\n";
static const char studio_plain_fragment[] =
    "#version 330 core\n"
    "in vec3 paint;\n" STUDIO_PAINT "void main() { colour = painted(paint); }\n";

/// Walls and water are large: the edges of shadows are where they are, not at their vertices.
static const char studio_still_vertex[] = STUDIO_PLACE
    "out vec3 at, sunny, shady; out vec2 tile; flat out vec3 seen;\n" STUDIO_PLAIN "void main() {\n"
    "    Skin s = skin_here(); vec3 base = mean * tint;\n"
    "    seen = beyond_of(base); sunny = over(tone(all_light(s, base, 1.0)), seen);\n"
    "    shady = over(tone(all_light(s, base, 0.0)), seen);\n"
    "}\n";
static const char studio_still_fragment[] =
    "#version 330 core\n"
    "in vec3 at, sunny, shady; flat in vec3 seen; layout(location=0, index=1) out vec4 beyond;\n"
    "uniform sampler2DShadow shadow; uniform mat4 to_shadow; uniform bool "
    "has_shadow;\n" STUDIO_PAINT STUDIO_LIT_ONCE
    "void main() { colour = painted(mix(shady, sunny, lit())); beyond = vec4(seen, 1.0); }\n";
