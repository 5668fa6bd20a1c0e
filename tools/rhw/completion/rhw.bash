# SPDX-License-Identifier: MIT
# Completion of rhw for bash: verbs, options, the values of options, and files where a file is wanted.

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

_rhw_render() { # CURRENT PREVIOUS
    case $2 in
    --output) _rhw_list "$1" color depth distance normal position uv object triangle bary all ;;
    --samples) _rhw_words "$1" 1 2 4 8 16 ;;
    --supersample) _rhw_words "$1" 1 4 9 16 ;;
    --bits) _rhw_words "$1" 8 16 ;;
    --format) _rhw_words "$1" png jpeg webp exr ppm ;;
    --interpolate) _rhw_words "$1" smooth noperspective ;;
    --background) _rhw_words "$1" default transparent environment black grey white red skyblue ;;
    --up) _rhw_words "$1" x y z -x -y -z ;;
    --lights) _rhw_words "$1" file default none ;;
    --transparency) _rhw_words "$1" sorted exact ;;
    --tone-map) _rhw_words "$1" neutral aces agx none ;;
    --environment | --confine) _rhw_files "$1" ;;
    --max-memory) _rhw_words "$1" 512M 1G 2G 4G ;;
    --max-time) _rhw_words "$1" 10 60 300 ;;
    --max-texture) _rhw_words "$1" 1024 2048 4096 8192 16384 ;;
    --shadows | --ambient-occlusion) _rhw_words "$1" on off ;;
    --isa) _rhw_words "$1" baseline avx2 avx512 ;;
    --paths) _rhw_words "$1" all in-order general ;;
    --size | -s) _rhw_words "$1" 512 1280x720 1920x1080 1024x1024 3840x2160 ;;
    --views) _rhw_list "$1" all front back left right top bottom iso ;;
    --animate) _rhw_words "$1" 12 24 30 60 ;;
    --turntable) _rhw_words "$1" 24 36 60 120 ;;
    --animation | --time | --orbit | --zoom | --margin | --quality | --camera | --camera-index | --camera-name | --fovy | --variant | --exposure | --environment-rotation | --threads | -j) ;;
    *)
        if [[ $1 == -* ]]; then
            _rhw_words "$1" --out --size --samples --supersample --output --bits --format --quality --fit --up --orbit --views --zoom --margin --ortho --print-camera --camera --camera-index \
                --camera-name --fovy --interpolate --wireframe --background --variant --animation --time --animate --turntable --lights --shadows --ground --ambient-occlusion --environment --environment-rotation --tone-map --transparency --exposure --threads --isa --paths \
                --max-memory --max-time --max-texture --confine --stats --strict --quiet --help
        else
            _rhw_files "$1"
        fi
        ;;
    esac
}

_rhw_compare() {
    case $2 in
    --tolerance | -t) ;;
    *)
        if [[ $1 == -* ]]; then
            _rhw_words "$1" --difference --tolerance --json --help
        else
            _rhw_files "$1"
        fi
        ;;
    esac
}

_rhw_info() {
    if [[ $1 == -* ]]; then
        _rhw_words "$1" --json --help
    else
        _rhw_files "$1"
    fi
}

_rhw_bench() {
    case $2 in
    --scene) _rhw_list "$1" $(rhw bench --list 2>/dev/null | cut -d ' ' -f 1) ;;
    --isa) _rhw_words "$1" baseline avx2 avx512 ;;
    --peer) _rhw_words "$1" llvmpipe softpipe none ;;
    --size | -s) _rhw_words "$1" 512 1280x720 1920x1080 3840x2160 ;;
    --save) _rhw_files "$1" ;;
    --frames | --threads | -j | --peer-threads) ;;
    *)
        _rhw_words "$1" --scene --list --size --frames --threads --isa --peer --peer-threads --json --csv --save \
            --help
        ;;
    esac
}

_rhw_thumbs() { # CURRENT PREVIOUS
    case $2 in
    --background) _rhw_words "$1" transparent default black grey white ;;
    --size | -s) _rhw_words "$1" 128 256 512 ;;
    --max-memory) _rhw_words "$1" 512M 1G 2G 4G ;;
    --max-time) _rhw_words "$1" 10 60 300 ;;
    --max-texture) _rhw_words "$1" 1024 2048 4096 8192 16384 ;;
    --confine) _rhw_files "$1" ;;
    --jobs | -j) ;;
    *)
        if [[ $1 == -* ]]; then
            _rhw_words "$1" --out --size --background --force --jobs --max-memory --max-time --max-texture --confine --quiet --help
        else
            _rhw_files "$1"
        fi
        ;;
    esac
}

_rhw() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        _rhw_words "$current" render thumbs compare info bench --help --version
        return
    fi
    case ${COMP_WORDS[1]} in
    render) _rhw_render "$current" "$previous" ;;
    thumbs) _rhw_thumbs "$current" "$previous" ;;
    compare) _rhw_compare "$current" "$previous" ;;
    info) _rhw_info "$current" "$previous" ;;
    bench) _rhw_bench "$current" "$previous" ;;
    esac
}

complete -F _rhw rhw
