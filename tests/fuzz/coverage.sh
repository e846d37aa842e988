#!/bin/bash
# coverage.sh BUILD CORPUS: line coverage of each target's own files by all inputs of a corpus folder (CORPUS/TARGET) and
# of the repository. BUILD is a build with the preset fuzz-coverage. Prints rows of the table in docs/robustness.md.
set -e
build=$(realpath "$1"); corpus=$(realpath "${2:-.}"); source=$(realpath "$(dirname "$0")/../..")
profdata=$(command -v llvm-profdata-14 || command -v llvm-profdata); cov=$(command -v llvm-cov-14 || command -v llvm-cov)
export CREVICE_DATA_DIR=$source
declare -A files=(
  [pipeline]="plan/Pipeline(Asset|Edits|Options|Text).*|plan/TargetFields|plan/ObjectReader|core/Json.*"
  [effect]="effect/(EffectAsset|EffectHeader|KeyReader|RenderStateReader|PriorityExpression|Includes|Declarations|Defines|GlslText|VariantBuilder)|core/Yaml.*"
  [material]="effect/(Material|PropertyTarget)"
  [scene]="scene/Scene(Asset|Fields|FileLookup)"
  [gltf]="scene/Gltf.*"
  [image]="core/(Hdr|Exr|Picture)"
  [cocosEffect]="cocos/((text|flatten|analysis|interface|reflection)/.*|CocosEffects|StageHead)"
  [cocosAsset]="cocos/((assets|import|scene)/.*|files/(Meta.*|NamedUuid|Uuid))")
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
for target in ${TARGETS:-pipeline effect material scene gltf image cocosEffect cocosAsset}; do
  program=$build/crevice_fuzz_$target
  inputs=("$source/tests/fuzz/corpus/$target"); [ -d "$corpus/$target" ] && inputs+=("$corpus/$target")
  LLVM_PROFILE_FILE=$work/$target.raw "$program" -runs=0 "${inputs[@]}" > "$work/$target.log" 2>&1
  $profdata merge -sparse "$work/$target.raw" -o "$work/$target.data"
  $cov report "$program" -instr-profile="$work/$target.data" > "$work/$target.txt" 2> /dev/null
  awk -v target="$target" -v files="pipeline/(${files[$target]})[.]cpp$" -v verbose="$VERBOSE" '
    $1 ~ files { lines += $8; missed += $9; if (verbose) printf "  %-40s %6d of %6d lines\n", $1, $8 - $9, $8 }
    END { printf "| %s | %d of %d | %.1f %% |\n", target, lines - missed, lines, 100 * (lines - missed) / lines }' "$work/$target.txt"
done
