#!/usr/bin/env bash
# Renders the pictures of the documents anew: tests/docs/make-pictures.sh [PROGRAM], from anywhere.
set -euo pipefail
cd "$(dirname "$0")/../.."
crevice=${1:-build/crevice}
scenes=tests/image/scenes
out=docs/images

render() { "$crevice" render -q "$@" >/dev/null; }
render default -o $out/default.png --size 800x450
render default -o $out/with-ao.png --size 480x270 --dump cc_ssaoBlurMap=$out/ao.png
render default -o $out/without-ao.png --size 480x270 --option ssao=false
render default -o $out/article.png --size 480x270 --option form=article
render default -o $out/forward.png --size 480x270 -p forward
render default -o $out/tone-aces.png --size 480x270 --set PostProcessStage.defines.TONEMAP=aces
render default -o $out/ambient.png --size 480x270 --option shadows=false
render default -o $out/gbuffer-normal.png --size 320x180 -p ao-only --option view=normal --dump cc_gbuffer_albedoMap=$out/gbuffer-albedo.png
render default -o $out/view-depth.png --size 320x180 -p ao-only --option view=depth
render $scenes/primitives.scene.json -o $out/primitives.png --size 480x270 --set cc_shadowMap.size=[512,512] --dump cc_shadowMap=$out/shadow-map.png
render $scenes/spot.scene.json -o $out/spot.png --size 480x270
render $scenes/fog.scene.json -o $out/fog.png --size 480x270
render $scenes/glass.scene.json -o $out/glass.png --size 480x270
render $scenes/environment.scene.json -o $out/environment.png --size 480x270
article=tests/cocos/article-v33
render default -o $out/cocos-article.png --size 480x270 -p $article/project/assets/pipeline/ssao-deferred-pipeline.rpp --engine $article/engine \
  --dump cc_ssaoMap=$out/cocos-article-ao.png
ao=(default --size 320x180 --option ao=gtao --option radius=0.6)
render "${ao[@]}" -p ao-deferred -o $out/light-ambient.png
render "${ao[@]}" -p ao-deferred -o $out/light-direct.png --option directStrength=1
render "${ao[@]}" -p ao-deferred -o $out/light-multibounce.png --option multiBounce=true
render "${ao[@]}" -p ao-deferred -o $out/light-albedo.png --option applyTo=albedo
for view in raw denoised edges; do render "${ao[@]}" -p ao-views -o $out/view-$view.png --option view=$view; done
maps=$(mktemp -d)
for denoiser in none box atrous; do
  render "${ao[@]}" -p ao-deferred -o "$maps/lit.png" --option denoiser=$denoiser --dump cc_ssaoBlurMap=$out/denoise-$denoiser.png
done
render "${ao[@]}" -p ao-deferred -o "$maps/lit.png" --option resolution=half --dump cc_ssaoBlurMap=$out/denoise-half.png
render "${ao[@]}" -p ao-deferred -o "$maps/ao.png" --dump cc_ssaoBlurMap="$maps/ao.exr" --dump viewDepth="$maps/depth.exr"
"$crevice" reference default -q -o "$maps/truth.exr" --size 320x180 --samples 256 --radius 0.6 --measure "$maps/ao.exr" \
  --depth "$maps/depth.exr" --heat $out/view-error.png >/dev/null
rm -r "$maps"
fence=(tests/bench/rail-fence.scene.json --size 320x180 --eye=-1.6,0.75,-1 --target=-1.9,0.6,-1.9 --fov 50 --near 0.02)
pictures=$(mktemp --suffix=.png)
thin() { render "${fence[@]}" -p ao-deferred -o "$pictures" --dump cc_ssaoBlurMap=$out/thin-$1.png "${@:2}"; }
thin gtao --option ao=gtao
thin vbao
thin vbao-015 --option thickness=0.15
thin vbao-backs --option backFaces=true
"$crevice" reference "${fence[@]}" -q -o $out/thin-truth.png --samples 256 >/dev/null
for technique in crytek cocos learnopengl; do
  for quality in high article; do
    suffix=; [ $quality = article ] && suffix=-article
    render default -o "$pictures" --size 480x270 -p ao-deferred --option ao=$technique --option quality=$quality \
      --dump cc_ssaoBlurMap=$out/ao-$technique$suffix.png
  done
done
rm "$pictures"
