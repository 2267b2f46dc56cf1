#!/bin/sh
# Takes pictures of the window with the samples and the real models, at 100 % and 150 %, for people to look at.
# usage: sh tests/gui/pictures.sh OUT_FOLDER [BUILD_FOLDER]
set -eu
out=${1:?usage: sh tests/gui/pictures.sh OUT_FOLDER [BUILD_FOLDER]}
cd -- "$(dirname -- "$0")/../.."
build=${2:-build/release}
data=../shared/data
cli=$build/app/cli/lorica-cli
mkdir -p "$out"

"$cli" template sample >"$out/sample.lorica.json"
if [ -d "$data/visible-human-male" ]; then
  "$cli" import "$data/visible-human-male/body.glb" "$data"/visible-human-male/organs_closed/*.glb --plates \
    --out "$out/visible_human.lorica.json" >"$out/visible_human.txt"
  "$cli" import "$data/makehuman-male/body.glb" --armor "$data/makehuman-male/armor/tactical_vest.glb" \
    --out "$out/makehuman.lorica.json" >"$out/makehuman.txt"
fi

take() {
  name=$1
  shift
  [ -r "$out/$name.lorica.json" ] || return 0
  for scale in 1 1.5; do
    echo "$name at $scale"
    QT_SCALE_FACTOR=$scale xvfb-run -a -s '-screen 0 2300x1500x24' \
      "$build/tests/gui/lorica_pictures" "$out" "${name}_$scale" "$out/$name.lorica.json" "$@"
  done
}

deform() {
  [ -r "$out/$1.lorica.json" ] || return 0
  for scale in 1 1.5; do
    echo "$1, deformation at $scale"
    QT_SCALE_FACTOR=$scale xvfb-run -a -s '-screen 0 2900x2000x24' \
      "$build/tests/gui/lorica_deformation_pictures" "$out" "$1_$scale" "$out/$1.lorica.json" "$2" "$3"
  done
}

shoot() {
  [ -r "$out/$1.lorica.json" ] || return 0
  for scale in 1 1.5; do
    echo "$1, sources and shots at $scale"
    QT_SCALE_FACTOR=$scale xvfb-run -a -s '-screen 0 2300x1500x24' \
      "$build/tests/gui/lorica_shot_pictures" "$out" "$1_$scale" "$out/$1.lorica.json"
  done
}

take sample toe_touch@2 belly_twist@1
take visible_human toe_touch@2 belly_twist@1
take makehuman toe_touch@2
deform sample liver belly_twist@1
deform visible_human Liver belly_twist@1
shoot sample
