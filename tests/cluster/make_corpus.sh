#!/usr/bin/env bash
# make_corpus.sh DIR MAKE_SITE
# Makes a corpus in the new folder DIR: the real models that are here, 200 generated ones in folders
# RWT1 ... RWT200, each with its metadata.json, and bad ones.
set -euo pipefail
corpus=$1
make_site=$2
checkout=$(cd "$(dirname "$0")/../.." && pwd)
model_count=200
base_count=20
base_dir=$(mktemp -d)
trap 'rm -rf "$base_dir"' EXIT

say() { printf 'make_corpus: %s\n' "$*" >&2; }

copy_real_models() {
  mkdir "$corpus/real"
  local data=$checkout/../shared/data installed=/usr/share/assimp/models folder
  if [ -d "$data" ]; then
    cp -a "$data/." "$corpus/real"
  else
    say "NOTE: no shared/data beside this checkout: WITHOUT its real models"
    for folder in OBJ PLY glTF2; do
      if [ -d "$installed/$folder" ]; then
        cp -a "$installed/$folder" "$corpus/real"
      else
        say "NOTE: no $installed/$folder either (package assimp-testmodels)"
      fi
    done
  fi
  chmod -R u+w "$corpus/real"
}

# Base 0 takes some seconds to measure, so that faults can hit it.
make_base() {
  local base=$1 faces=$((200 + $1 * 61)) options=(--texture-format none)
  [ "$base" -ne 0 ] || faces=1000000
  case $((base % 8)) in
    1) options=(--textures 2 --texture-size 32 --texture-format png) ;;
    5) options=(--textures 1 --texture-size 64 --texture-format jpg --shuffle-faces "$base") ;;
    3 | 7) options+=(--duplicate-vertices) ;;
  esac
  "$make_site" --faces "$faces" "${options[@]}" --out "$base_dir/$base" --name site >/dev/null
}

make_bases() {
  local base
  for base in $(seq 0 $((base_count - 1))); do make_base "$base"; done
}

# As others write it, with its gaps and faults.
write_metadata() {
  local id=$1 file=$2
  local name="Generated site $id" author="Ada Mason" text="A ground with roofs, number $id"
  case $((id % 20)) in
    5) name="Stiftskirche Sankt Pölten $id" author="Jürgen Weiß" ;;
    6) name="広隆寺 $id" author="山田 太郎" text="\"Kōryū-ji\", Kyōto, 弥勒菩薩 🏯" ;;
    7) return ;;
  esac
  if [ "$id" -eq 13 ]; then
    printf '{"name": "cut off", "tags": [' >"$file"
    return
  fi
  text=${text//\"/\\\"}
  printf '{"name": "%s", "author": "%s", "licence": "CC-BY-4.0", "description": "%s",\n "date": "%s", "tags": ["generated", "roof %s"]}\n' \
    "$name" "$author" "$text" "2020-02-$((10 + id % 19))" "$id" >"$file"
}

# A base without some of its last faces, so that no two are the same; whole, and with the answers
# that its report must give, in the first folders.
make_model() {
  local id=$1 base folder=$corpus/RWT$1 name=site cut=$((($1 - 1) / (base_count - 1)))
  case $id in
    17 | 50 | 83 | 116 | 149 | 182) base=0 ;;
    *) base=$((id % (base_count - 1) + 1)) ;;
  esac
  [ $((id % 20)) -ne 5 ] || name="Sankt Pölten $id"
  mkdir "$folder"
  cp "$base_dir/$base"/site.mtl "$folder"
  find "$base_dir/$base" -name 'site_*' -exec cp -t "$folder" {} +
  head -n "-$cut" "$base_dir/$base/site.obj" >"$folder/$name.obj"
  [ "$cut" -ne 0 ] || cp "$base_dir/$base/site.answers.json" "$folder"
  [ $((id % 25)) -ne 11 ] || gzip "$folder/$name.obj"
  write_metadata "$id" "$folder/metadata.json"
}

# The last two are the same but for their metadata.
make_models() {
  local id
  for id in $(seq $((model_count - 1))); do make_model "$id"; done
  cp -a "$corpus/RWT$((model_count - 1))" "$corpus/RWT$model_count"
  write_metadata "$model_count" "$corpus/RWT$model_count/metadata.json"
}

# What must fail is bad/fails*.
make_bad_models() {
  local bad=$corpus/bad site=$base_dir/1/site.obj
  mkdir -p "$bad/fails_folder.obj"
  head -c 50000 "$make_site" >"$bad/fails_garbage.obj"
  : >"$bad/fails_empty.obj"
  gzip -c "$site" | head -c 2000 >"$bad/fails_truncated.obj.gz"
  printf 'ply\nformat binary_little_endian 1.0\nelement vertex 1000\nproperty float x\nproperty float y\nproperty float z\nend_header\nabc' \
    >"$bad/fails_truncated.ply"
  printf 'newmtl absent\nmap_Kd absent.png\n' >"$bad/absent.mtl"
  printf 'mtllib absent.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl absent\nf 1/1 2/2 3/3\n' \
    >"$bad/texture_missing.obj"
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$bad/fails_folder.obj/inside.obj"
}

mkdir "$corpus"
copy_real_models
make_bases
make_models
make_bad_models
say "$(find "$corpus" -type f | wc -l) files, $(du -sh "$corpus" | cut -f 1)"
