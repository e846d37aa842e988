#!/usr/bin/env python3
"""Writes a Cocos project of an engine's size for crevice_effect_bench: 62 chunks in layers that include each other, and
effects of 6 to 10 passes whose stages have 1600 lines on average when they are put together.

    python3 tests/bench/make_cocos_project.py FOLDER
    crevice_effect_bench FOLDER
    crevice effects compile --engine FOLDER
"""
import argparse
import os
import random

MACROS = """USE_NORMAL_DETAIL USE_BASE_TEXTURE USE_MASK USE_TINT USE_SECOND_LAYER USE_RIM USE_WRAP_LIGHT HAS_SECOND_UV
    USE_VERTEX_TINT USE_SKIN USE_MORPHING USE_COPIES CC_USE_FOG CC_USE_HDR CC_USE_IBL CC_RECEIVE_SHADOW
    CC_SUPPORT_CASCADED_SHADOW_MAP USE_LIGHTMAP USE_CLEAR_COAT USE_ANISO USE_SHEEN USE_PARALLAX USE_DITHER
    USE_DISTANCE_FADE USE_SNOW USE_WET USE_WIND USE_FLIPBOOK USE_SOFT USE_OUTLINE""".split()

LAYERS = [("common/math", 9), ("common/color", 6), ("common/texture", 6), ("common/lighting", 9),
          ("builtin/functionalities", 8), ("surfaces/data", 7), ("surfaces/modules", 12)]

FRAME = "".join(f"  highp vec4 cc_word{i};\n" for i in range(18))

FIXED_CHUNKS = {
    "common/words": "#define SQUARED_TERM(x, y) x = (x) * (x) + (y)\n#define HIGH_RANGE 65504.0\n"
                    "#define decodeRange(v) (v) * HIGH_RANGE\n#pragma define SOFT_EDGE 0.25\n"
                    + "".join(f"#define LEVEL_{i} {i}\n" for i in range(30)),
    "builtin/uniforms/cc-global": "#pragma builtin(global)\nlayout(set = 0, binding = 0) uniform CCGlobal {\n" + FRAME
                                  + "  highp mat4 cc_matView;\n  highp mat4 cc_matViewProj;\n};\n",
    "builtin/uniforms/cc-local": "#pragma builtin(local)\nlayout(set = 2, binding = 0) uniform CCLocal {\n"
                                 "  highp mat4 cc_matWorld;\n  highp mat4 cc_matWorldIT;\n"
                                 "  highp vec4 cc_lightingMapUVParam;\n};\n",
    "builtin/uniforms/cc-shadow": "#pragma builtin(global)\nlayout(set = 0, binding = 2) uniform CCShadow {\n"
                                  "  highp mat4 cc_matLightView;\n  highp mat4 cc_matLightViewProj;\n"
                                  "  mediump vec4 cc_shadowWords[6];\n};\n#if CC_RECEIVE_SHADOW\n"
                                  "#pragma builtin(global)\n"
                                  "layout(set = 0, binding = 4) uniform highp sampler2D cc_shadowMap;\n#endif\n",
    "legacy/input": "in vec3 a_position;\nin vec3 a_normal;\nin vec2 a_texCoord;\nin vec4 a_tangent;\n"
                    "#if HAS_SECOND_UV\n  in vec2 a_texCoord1;\n#endif\n"
                    "#if USE_VERTEX_TINT\n  in vec4 a_color;\n#endif\n"
                    "#if USE_SKIN\n  in uvec4 a_joints;\n  in vec4 a_weights;\n#endif\n"
                    "#if USE_COPIES\n  in vec4 a_matWorld0;\n  in vec4 a_matWorld1;\n  in vec4 a_matWorld2;\n#endif\n",
}

VARYINGS = """  {0} vec3 v_position;
  {0} vec3 v_normal;
  {0} vec2 v_uv;
  #if USE_VERTEX_TINT
    {0} vec4 v_color;
  #endif
  #if CC_RECEIVE_SHADOW
    {0} vec4 v_shadowPos;
  #endif
"""

VERTEX_MAIN = """
  void main () {
    vec4 p = vec4(a_position, 1.0);
    vec3 n = a_normal;
    #if USE_SKIN
      p.xyz += vec3(a_joints.xyz) * a_weights.x;
    #endif
    #if USE_COPIES
      p.xyz = vec3(dot(a_matWorld0, p), dot(a_matWorld1, p), dot(a_matWorld2, p));
    #endif
    vec3 bend = BEND(p.xyz, n, 0.5);
    v_position = (cc_matWorld * p).xyz + bend * 0.01;
    v_normal = normalize((cc_matWorldIT * vec4(n, 0.0)).xyz);
    v_uv = a_texCoord;
    #if USE_VERTEX_TINT
      v_color = a_color;
    #endif
    #if CC_RECEIVE_SHADOW
      v_shadowPos = cc_matLightViewProj * vec4(v_position, 1.0);
    #endif
    gl_Position = cc_matViewProj * vec4(v_position, 1.0);
  }
}%
"""

PASSES = """    - &add { vert: solid-vs, frag: solid-fs, phase: forward-add, propertyIndex: 0,
        embeddedMacros: { CC_FORWARD_ADD: true }, depthStencilState: { depthFunc: equal, depthWrite: false },
        blendState: { targets: [ { blend: true, blendSrc: one, blendDst: one } ] } }
    - &caster { vert: "caster-vs:vert", frag: "caster-fs:frag", phase: shadow-caster, propertyIndex: 0,
        rasterizerState: { cullMode: front } }
    - &deferred { vert: solid-vs, frag: buffer-fs, phase: deferred, propertyIndex: 0,
        embeddedMacros: { CC_PIPELINE_TYPE: 1 } }
    - &reflect { vert: solid-vs, frag: reflect-fs, phase: reflect-map, propertyIndex: 0 }
"""

CASTER_VERTEX = """CCProgram caster-vs %{
  precision highp float;
""" + "".join(f"  #include <{name}>\n" for name in FIXED_CHUNKS if name != "common/words") + """  out vec2 v_depth;
  vec4 vert () {
    vec4 clip = cc_matLightViewProj * (cc_matWorld * vec4(a_position, 1.0));
    v_depth = clip.zw;
    return clip;
  }
}%
"""


def statement(rng, index, macros, callees):
    """A statement or two of a chunk's function."""
    a, b, axis = rng.random() * 4, rng.random(), rng.choice("xyz")
    kinds = [f"  sum += normal * (amount * {a:.4f} + {b:.3f}); // step {index}",
             f"  float t{index} = clamp(dot(normal, position) * {a:.3f}, 0.0, 1.0);\n"
             f"  sum = mix(sum, position, t{index});",
             f"  #if {rng.choice(macros)}\n    sum *= max(vec3({a:.3f}), normalize(position + {b:.3f}));\n"
             f"  #else\n    sum -= vec3({b:.3f}, amount, {a:.2f});\n  #endif",
             f"  for (int i = 0; i < {2 + index % 4}; i++) {{ sum.x += pow(abs(sum.y) + {b:.3f}, {a:.3f}); }}",
             f"  SQUARED_TERM(sum.z, {a:.3f});",
             f"  if (sum.x > {a:.3f}) {{\n    sum.y = sqrt(abs(sum.x)) * {b:.4f};\n"
             f"  }} else {{\n    sum.z += sin(position.{axis} * {a:.4f});\n  }}"]
    if callees:
        kinds.append(f"  sum += {rng.choice(callees)}(position * {a:.2f}, normal, amount * {b:.3f});")
    return rng.choice(kinds)


def function(rng, name, macros, callees):
    lines = [f"// {name}: a weighted walk over what is around the point.",
             "/* Positions in metres.\n   The sum is kept in highp. */",
             f"vec3 {name} (in vec3 position, vec3 normal, float amount) {{", "  vec3 sum = vec3(0.0);"]
    lines += [statement(rng, i, macros, callees) for i in range(rng.randrange(4, 16))]
    return "\n".join(lines + ["  return sum;", "}\n"])


def make_chunks(rng, write):
    """Returns the functions of each chunk, by layer and name."""
    layers = []
    for number, (folder, count) in enumerate(LAYERS):
        lower = {name: names for layer in layers for name, names in layer.items()}
        layers.append({})
        for part in range(count):
            name, macros = f"{folder}/part{number}-{part}", rng.sample(MACROS, 4)
            includes = rng.sample(sorted(lower), min(len(lower), rng.randrange(1, 4)))
            callees = [callee for include in includes for callee in lower[include]]
            text = [f"// {name}: a part of layer {number}."]
            text += [f"#include <{include}>" for include in ["common/words"] + includes]
            names = [f"part{number}x{part}x{i}" for i in range(rng.randrange(2, 6))]
            for own in names:
                body = function(rng, own, macros, callees)
                other = f"vec3 {own} (vec3 p, vec3 n, float a) {{ return p * n * a; }}\n"
                text.append(f"#if {macros[0]}\n{body}#else\n{other}#endif" if rng.random() < 0.25 else body)
            write(f"chunks/{name}.chunk", "\n".join(text))
            layers[-1][name] = names
    return layers


def fragment(rng, name, includes, functions, macros, outputs):
    calls = [f"    color += {rng.choice(functions[c])}(v_position, n, {rng.random():.3f});" for c in includes]
    maps = [f"    #if {macro}\n      color *= texture(tex{i % 4}, v_uv * {rng.random():.3f}).rgb;\n    #endif"
            for i, macro in enumerate(macros)]
    shared = ["builtin/uniforms/cc-global", "builtin/uniforms/cc-shadow", "shared-words"]
    text = [f"CCProgram {name} %{{", "  precision highp float;"]
    text += [f"  #include <{include}>" for include in shared + includes]
    text += [VARYINGS.format("in"), "  #pragma define-meta QUALITY range([0, 3])",
             "  #pragma define-meta TINT_SOURCE options([r, g, b, a])", "  vec3 gather (vec3 n) {",
             "    vec3 color = word0.rgb * word1.TINT_SOURCE;"] + calls + maps
    text += ["    #if QUALITY > 1", "      color += word2.xyz * SOFT_EDGE;", "    #elif QUALITY == 1",
             "      color -= word3.xyz;", "    #endif", "    #if CC_RECEIVE_SHADOW",
             "      color *= texture(cc_shadowMap, v_shadowPos.xy).r;", "    #endif", "    return color;", "  }"]
    text += [f"  layout(location = {i}) out vec4 fragColor{i};" for i in range(outputs)]
    text += ["  void main () {", "    vec3 n = normalize(v_normal);"]
    text += [f"    fragColor{i} = vec4(gather(n) + word{i + 4}.xyz, 1.0);" for i in range(outputs)]
    return "\n".join(text + ["  }", "}%\n"])


def header(rng, macros):
    text = ["CCEffect %{", "  techniques:", "  - name: opaque", "    passes:", "    - &main",
            "      vert: solid-vs", "      frag: solid-fs", "      properties:"]
    text += [f"        prop{i}: {{ value: [{rng.random():.2f}, 0.5, 0.25, 1.0], target: word{i}, "
             f"editor: {{ displayName: Word {i}, type: color, parent: {rng.choice(macros)} }} }}" for i in range(10)]
    text += [f"        tex{i}: {{ value: white, editor: {{ displayName: Map {i} }} }}" for i in range(4)]
    text += [PASSES + "  - name: transparent", "    passes:"]
    for i in range(rng.randrange(1, 6)):
        text += [f"    - <<: *{['main', 'add', 'caster', 'deferred'][i % 4]}",
                 "      blendState: { targets: [ { blend: true, blendSrc: src_alpha } ] }"]
    text += ["}%", "CCProgram shared-words %{", "  uniform Words {"] + [f"    vec4 word{i};" for i in range(10)]
    return "\n".join(text + ["  };"] + [f"  uniform sampler2D tex{i};" for i in range(4)] + ["}%\n"])


def make_effect(rng, layers):
    functions = {name: names for layer in layers for name, names in layer.items()}
    used = rng.sample(sorted(name for layer in layers[3:] for name in layer), rng.randrange(6, 16))
    of_vertex = rng.sample(sorted(layers[0]) + sorted(layers[4]), 3)
    of_caster = rng.choice(sorted(layers[1]))
    macros = rng.sample(MACROS, 12)
    vertex = [name for name in FIXED_CHUNKS if name != "common/words"] + of_vertex
    return "".join([
        header(rng, macros), "CCProgram solid-vs %{\n  precision highp float;\n",
        "".join(f"  #include <{name}>\n" for name in vertex), VARYINGS.format("out"),
        VERTEX_MAIN.replace("BEND", functions[of_vertex[0]][0]),
        fragment(rng, "solid-fs", used, functions, macros, 1),
        fragment(rng, "buffer-fs", used[:len(used) // 2 + 1], functions, macros, 4),
        fragment(rng, "reflect-fs", used[:3], functions, macros, 1), CASTER_VERTEX,
        f"CCProgram caster-fs %{{\n  precision highp float;\n  #include <{of_caster}>\n  in vec2 v_depth;\n"
        f"  vec4 frag () {{\n    vec3 bias = {functions[of_caster][0]}(vec3(v_depth, 1.0), vec3(1.0), 0.1);\n"
        "    return vec4(v_depth.x / v_depth.y * 0.5 + 0.5, bias.x * 0.0001, 0.0, 1.0);\n  }\n}%\n"])


def main(folder, count):
    def write(path, text):
        full = os.path.join(folder, "editor/assets", path)
        os.makedirs(os.path.dirname(full), exist_ok=True)
        with open(full, "w", encoding="utf-8") as file:
            file.write(text)

    for name, text in FIXED_CHUNKS.items():
        write(f"chunks/{name}.chunk", text)
    layers = make_chunks(random.Random(7), write)
    for i in range(count):
        write(f"effects/group{i % 10}/effect-{i:03d}.effect", make_effect(random.Random(1000 + i), layers))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="FOLDER")
    parser.add_argument("effects", metavar="EFFECTS", nargs="?", type=int, default=100, help="how many (100)")
    options = parser.parse_args()
    main(options.folder, options.effects)
