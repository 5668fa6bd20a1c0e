# SPDX-License-Identifier: MIT
# Completion of rhw for bash: verbs, options, their values, and files. Made by script/completions.

_rhw_words() { # CURRENT WORD...: those that begin with CURRENT
    local current=$1
    shift
    mapfile -t COMPREPLY < <(compgen -W "$*" -- "$current")
}

# A list separated by commas: completes what follows the last comma.
_rhw_list() { # CURRENT WORD...
    local current=$1 before=
    shift
    [[ $current == *,* ]] && before=${current%,*},
    mapfile -t COMPREPLY < <(compgen -P "$before" -W "$*" -- "${current##*,}")
    compopt -o nospace 2>/dev/null
}

_rhw_files() { # CURRENT
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$1")
}

_rhw_rest() { # CURRENT file|none OPTION...: what is no value of an option
    if [[ $1 == -* || $2 == none ]]; then
        _rhw_words "$1" "${@:3}"
    else
        _rhw_files "$1"
    fi
}

_rhw_render() { # CURRENT PREVIOUS
    case $2 in
    --out | -o) _rhw_files "$1" ;;
    --size | -s) _rhw_words "$1" 512 1280x720 1920x1080 1024x1024 3840x2160 ;;
    --samples) _rhw_words "$1" 1 2 4 8 16 ;;
    --supersample) _rhw_words "$1" 1 4 9 16 ;;
    --output) _rhw_list "$1" color depth distance normal position uv object triangle bary overdraw tiles plan all ;;
    --bits) _rhw_words "$1" 8 16 ;;
    --format) _rhw_words "$1" png jpeg webp exr ppm ;;
    --up) _rhw_words "$1" x y z -x -y -z ;;
    --views) _rhw_list "$1" all front back left right top bottom iso ;;
    --interpolate) _rhw_words "$1" smooth noperspective ;;
    --background) _rhw_words "$1" default transparent environment black grey white red skyblue ;;
    --animate) _rhw_words "$1" 12 24 30 60 ;;
    --turntable) _rhw_words "$1" 24 36 60 120 ;;
    --lights) _rhw_words "$1" file default none ;;
    --shadows) _rhw_words "$1" on off ;;
    --ambient-occlusion) _rhw_words "$1" on off ;;
    --environment) _rhw_files "$1" ;;
    --tone-map) _rhw_words "$1" neutral aces agx none ;;
    --transparency) _rhw_words "$1" sorted exact ;;
    --isa) _rhw_words "$1" baseline avx2 avx512 ;;
    --paths) _rhw_words "$1" all in-order general ;;
    --max-memory) _rhw_words "$1" 512M 1G 2G 4G ;;
    --max-time) _rhw_words "$1" 10 60 300 ;;
    --max-texture) _rhw_words "$1" 1024 2048 4096 8192 16384 ;;
    --quality | --zoom | --margin | --orbit | --camera | --camera-index | --camera-name | --fovy | --variant | --animation | --time | --environment-rotation | --exposure | --threads | -j) ;;
    *) _rhw_rest "$1" file --out --literal --size --samples --supersample --output --bits --format --quality --fit --up --zoom --margin --ortho --print-camera --orbit --views --camera --camera-index --camera-name --fovy --interpolate --wireframe --background --variant --animation --time --animate --turntable --lights --shadows --ground --ambient-occlusion --environment --environment-rotation --tone-map --transparency --exposure --threads --isa --paths --max-memory --max-time --max-texture --confine --stats --strict --quiet --help ;;
    esac
}

_rhw_thumbs() { # CURRENT PREVIOUS
    case $2 in
    --out | -o) _rhw_files "$1" ;;
    --size | -s) _rhw_words "$1" 128 256 512 ;;
    --background) _rhw_words "$1" transparent default black grey white ;;
    --max-memory) _rhw_words "$1" 512M 1G 2G 4G ;;
    --max-time) _rhw_words "$1" 10 60 300 ;;
    --max-texture) _rhw_words "$1" 1024 2048 4096 8192 16384 ;;
    --confine) _rhw_files "$1" ;;
    --jobs | -j) ;;
    *) _rhw_rest "$1" file --out --size --background --fit --force --jobs --max-memory --max-time --max-texture --confine --quiet --help ;;
    esac
}

_rhw_compare() { # CURRENT PREVIOUS
    case $2 in
    --difference | -d) _rhw_files "$1" ;;
    --max-memory) _rhw_words "$1" 512M 1G 2G 4G ;;
    --max-time) _rhw_words "$1" 10 60 300 ;;
    --tolerance | -t) ;;
    *) _rhw_rest "$1" file --difference --tolerance --json --max-memory --max-time --help ;;
    esac
}

_rhw_explain() { # CURRENT PREVIOUS
    case $2 in
    --picture) _rhw_files "$1" ;;
    --size | -s) _rhw_words "$1" 512 1280x720 1920x1080 1024x1024 3840x2160 ;;
    --samples) _rhw_words "$1" 1 2 4 8 16 ;;
    --supersample) _rhw_words "$1" 1 4 9 16 ;;
    --up) _rhw_words "$1" x y z -x -y -z ;;
    --interpolate) _rhw_words "$1" smooth noperspective ;;
    --background) _rhw_words "$1" default transparent environment black grey white red skyblue ;;
    --lights) _rhw_words "$1" file default none ;;
    --shadows) _rhw_words "$1" on off ;;
    --ambient-occlusion) _rhw_words "$1" on off ;;
    --environment) _rhw_files "$1" ;;
    --tone-map) _rhw_words "$1" neutral aces agx none ;;
    --isa) _rhw_words "$1" baseline avx2 avx512 ;;
    --paths) _rhw_words "$1" all in-order general ;;
    --max-memory) _rhw_words "$1" 512M 1G 2G 4G ;;
    --max-time) _rhw_words "$1" 10 60 300 ;;
    --max-texture) _rhw_words "$1" 1024 2048 4096 8192 16384 ;;
    --at | --sample | --zoom | --margin | --orbit | --camera | --camera-index | --camera-name | --fovy | --variant | --animation | --time | --environment-rotation | --exposure | --threads | -j) ;;
    *) _rhw_rest "$1" file --at --sample --json --picture --size --samples --supersample --fit --up --zoom --margin --ortho --orbit --camera --camera-index --camera-name --fovy --interpolate --wireframe --background --variant --animation --time --lights --shadows --ground --ambient-occlusion --environment --environment-rotation --tone-map --exposure --threads --isa --paths --max-memory --max-time --max-texture --confine --quiet --help ;;
    esac
}

_rhw_view() { # CURRENT PREVIOUS
    case $2 in
    --size | -s) _rhw_words "$1" 512 1280x720 1920x1080 1024x1024 3840x2160 ;;
    --samples) _rhw_words "$1" 1 2 4 8 16 ;;
    --supersample) _rhw_words "$1" 1 4 9 16 ;;
    --output) _rhw_list "$1" color depth distance normal position uv object triangle bary overdraw tiles plan all ;;
    --bits) _rhw_words "$1" 8 16 ;;
    --up) _rhw_words "$1" x y z -x -y -z ;;
    --interpolate) _rhw_words "$1" smooth noperspective ;;
    --background) _rhw_words "$1" default transparent environment black grey white red skyblue ;;
    --lights) _rhw_words "$1" file default none ;;
    --shadows) _rhw_words "$1" on off ;;
    --ambient-occlusion) _rhw_words "$1" on off ;;
    --environment) _rhw_files "$1" ;;
    --tone-map) _rhw_words "$1" neutral aces agx none ;;
    --transparency) _rhw_words "$1" sorted exact ;;
    --isa) _rhw_words "$1" baseline avx2 avx512 ;;
    --paths) _rhw_words "$1" all in-order general ;;
    --max-memory) _rhw_words "$1" 512M 1G 2G 4G ;;
    --max-texture) _rhw_words "$1" 1024 2048 4096 8192 16384 ;;
    --zoom | --margin | --orbit | --camera | --camera-index | --camera-name | --fovy | --variant | --animation | --time | --environment-rotation | --exposure | --threads | -j) ;;
    *) _rhw_rest "$1" file --fullscreen --size --samples --supersample --output --bits --fit --up --zoom --margin --ortho --orbit --camera --camera-index --camera-name --fovy --interpolate --wireframe --background --variant --animation --time --lights --shadows --ground --ambient-occlusion --environment --environment-rotation --tone-map --transparency --exposure --threads --isa --paths --max-memory --max-texture --confine --quiet --help ;;
    esac
}

_rhw_info() { # CURRENT PREVIOUS
    case $2 in
    *) _rhw_rest "$1" file --json --help ;;
    esac
}

_rhw_bench() { # CURRENT PREVIOUS
    case $2 in
    --scene) _rhw_list "$1" $(rhw bench --list 2>/dev/null | cut -d ' ' -f 1) ;;
    --size | -s) _rhw_words "$1" 512 1280x720 1920x1080 3840x2160 ;;
    --isa) _rhw_words "$1" baseline avx2 avx512 ;;
    --peer) _rhw_words "$1" llvmpipe softpipe none ;;
    --save) _rhw_files "$1" ;;
    --frames | --threads | -j | --peer-threads) ;;
    *) _rhw_rest "$1" none --scene --list --size --frames --threads --isa --peer --peer-threads --json --csv --save --help ;;
    esac
}

_rhw() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        _rhw_words "$current" render thumbs compare explain view info bench help --help --version
        return
    fi
    case ${COMP_WORDS[1]} in
    help) _rhw_words "$current" render thumbs compare explain view info bench ;;
    render | thumbs | compare | explain | view | info | bench) "_rhw_${COMP_WORDS[1]}" "$current" "$previous" ;;
    esac
}

complete -F _rhw rhw
