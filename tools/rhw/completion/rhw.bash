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

# Completes the value of an option of all verbs that draw as rhw render does. Fails behind any other word.
_rhw_drawing() { # CURRENT PREVIOUS
    case $2 in
    --size | --size= | -s) _rhw_words "$1" 512 1280x720 1920x1080 1024x1024 3840x2160 ;;
    --samples | --samples=) _rhw_words "$1" 1 2 4 8 16 ;;
    --supersample | --supersample=) _rhw_words "$1" 1 4 9 16 ;;
    --fit=) _rhw_words "$1" all ;;
    --up | --up=) _rhw_words "$1" x y z -x -y -z ;;
    --interpolate | --interpolate=) _rhw_words "$1" smooth noperspective ;;
    --wireframe=) _rhw_words "$1" over plain ;;
    --background | --background=) _rhw_words "$1" default transparent environment black grey white red skyblue ;;
    --lights | --lights=) _rhw_words "$1" file default none ;;
    --shadows | --shadows=) _rhw_words "$1" on off ;;
    --ambient-occlusion | --ambient-occlusion=) _rhw_words "$1" on off ;;
    --environment | --environment=) _rhw_files "$1" ;;
    --tone-map | --tone-map=) _rhw_words "$1" neutral aces agx none ;;
    --isa | --isa=) _rhw_words "$1" baseline avx2 avx512 ;;
    --paths | --paths=) _rhw_words "$1" all in-order general ;;
    --max-memory | --max-memory=) _rhw_words "$1" 512M 1G 2G 4G ;;
    --max-texture | --max-texture=) _rhw_words "$1" 1024 2048 4096 8192 16384 ;;
    --confine=) _rhw_files "$1" ;;
    --zoom | --zoom= | --margin | --margin= | --orbit | --orbit= | --camera | --camera= | --camera-index | --camera-index= | --camera-name | --camera-name= | --fovy | --fovy= | --variant | --variant= | --animation | --animation= | --time | --time= | --environment-rotation | --environment-rotation= | --exposure | --exposure= | --threads | --threads= | -j) ;;
    *) return 1 ;;
    esac
    return 0
}

_rhw_render() { # CURRENT PREVIOUS
    case $2 in
    --out | --out= | -o) _rhw_files "$1" ;;
    --output | --output=) _rhw_list "$1" color depth distance normal position uv object triangle bary overdraw tiles plan all ;;
    --bits | --bits=) _rhw_words "$1" 8 16 ;;
    --format | --format=) _rhw_words "$1" png jpeg webp exr ppm ;;
    --views | --views=) _rhw_list "$1" all front back left right top bottom iso ;;
    --animate | --animate=) _rhw_words "$1" 12 24 30 60 ;;
    --turntable | --turntable=) _rhw_words "$1" 24 36 60 120 ;;
    --transparency | --transparency=) _rhw_words "$1" sorted exact ;;
    --fragment-shader | --fragment-shader=) _rhw_files "$1" ;;
    --max-time | --max-time=) _rhw_words "$1" 10 60 300 ;;
    --stats=) _rhw_files "$1" ;;
    --quality | --quality=) ;;
    *) _rhw_drawing "$1" "$2" || _rhw_rest "$1" file --out --literal --size --samples --supersample --output --bits --format --quality --fit --up --zoom --margin --ortho --print-camera --orbit --views --camera --camera-index --camera-name --fovy --interpolate --wireframe --background --variant --animation --time --animate --turntable --lights --shadows --ground --ambient-occlusion --environment --environment-rotation --tone-map --transparency --exposure --fragment-shader --fragment-shader-template --threads --isa --paths --max-memory --max-time --max-texture --confine --stats --strict --quiet --help ;;
    esac
}

_rhw_thumbs() { # CURRENT PREVIOUS
    case $2 in
    --out | --out= | -o) _rhw_files "$1" ;;
    --size | --size= | -s) _rhw_words "$1" 128 256 512 ;;
    --background | --background=) _rhw_words "$1" transparent default black grey white ;;
    --fit=) _rhw_words "$1" all ;;
    --max-memory | --max-memory=) _rhw_words "$1" 512M 1G 2G 4G ;;
    --max-time | --max-time=) _rhw_words "$1" 10 60 300 ;;
    --max-texture | --max-texture=) _rhw_words "$1" 1024 2048 4096 8192 16384 ;;
    --confine | --confine=) _rhw_files "$1" ;;
    --jobs | --jobs= | -j) ;;
    *) _rhw_rest "$1" file --out --size --background --fit --force --jobs --max-memory --max-time --max-texture --confine --quiet --help ;;
    esac
}

_rhw_compare() { # CURRENT PREVIOUS
    case $2 in
    --difference | --difference= | -d) _rhw_files "$1" ;;
    --max-memory | --max-memory=) _rhw_words "$1" 512M 1G 2G 4G ;;
    --max-time | --max-time=) _rhw_words "$1" 10 60 300 ;;
    --tolerance | --tolerance= | -t) ;;
    *) _rhw_rest "$1" file --difference --tolerance --json --max-memory --max-time --help ;;
    esac
}

_rhw_explain() { # CURRENT PREVIOUS
    case $2 in
    --picture | --picture=) _rhw_files "$1" ;;
    --max-time | --max-time=) _rhw_words "$1" 10 60 300 ;;
    --at | --at= | --sample | --sample=) ;;
    *) _rhw_drawing "$1" "$2" || _rhw_rest "$1" file --at --sample --json --picture --size --samples --supersample --fit --up --zoom --margin --ortho --orbit --camera --camera-index --camera-name --fovy --interpolate --wireframe --background --variant --animation --time --lights --shadows --ground --ambient-occlusion --environment --environment-rotation --tone-map --exposure --threads --isa --paths --max-memory --max-time --max-texture --confine --quiet --help ;;
    esac
}

_rhw_view() { # CURRENT PREVIOUS
    case $2 in
    --output | --output=) _rhw_list "$1" color depth distance normal position uv object triangle bary overdraw tiles plan all ;;
    --bits | --bits=) _rhw_words "$1" 8 16 ;;
    --transparency | --transparency=) _rhw_words "$1" sorted exact ;;
    *) _rhw_drawing "$1" "$2" || _rhw_rest "$1" file --fullscreen --size --samples --supersample --output --bits --fit --up --zoom --margin --ortho --orbit --camera --camera-index --camera-name --fovy --interpolate --wireframe --background --variant --animation --time --lights --shadows --ground --ambient-occlusion --environment --environment-rotation --tone-map --transparency --exposure --threads --isa --paths --max-memory --max-texture --confine --quiet --help ;;
    esac
}

_rhw_info() { # CURRENT PREVIOUS
    case $2 in
    *) _rhw_rest "$1" file --json --help ;;
    esac
}

_rhw_shader() { # CURRENT PREVIOUS
    case $2 in
    --out | --out= | -o) _rhw_files "$1" ;;
    --print | --print=) _rhw_words "$1" info spirv ir bytecode code ;;
    --after | --after=) _rhw_words "$1" build passes ;;
    --include | --include= | -I) _rhw_files "$1" ;;
    --depfile | --depfile=) _rhw_files "$1" ;;
    --size | --size=) _rhw_words "$1" 512 1280x720 1920x1080 1024x1024 3840x2160 ;;
    --max-memory | --max-memory=) _rhw_words "$1" 512M 1G 2G 4G ;;
    --max-time | --max-time=) _rhw_words "$1" 10 60 300 ;;
    --entry | --entry= | --define | --define= | -D | --constant | --constant= | --time | --time= | --mouse | --mouse= | --texture | --texture= | --groups | --groups= | --buffer | --buffer= | --push | --push= | --result | --result= | --threads | --threads=) ;;
    *) _rhw_rest "$1" file --out --print --after --json --all-errors --strict --entry --define --include --constant --relaxed --depfile --run --size --time --mouse --texture --groups --buffer --push --result --threads --max-memory --max-time --help ;;
    esac
}

_rhw_bench() { # CURRENT PREVIOUS
    case $2 in
    --scene | --scene=) _rhw_list "$1" $(rhw bench --list 2>/dev/null | cut -d ' ' -f 1) ;;
    --size | --size= | -s) _rhw_words "$1" 512 1280x720 1920x1080 3840x2160 ;;
    --isa | --isa=) _rhw_words "$1" baseline avx2 avx512 ;;
    --peer | --peer=) _rhw_words "$1" llvmpipe softpipe interpreter machine emitted none ;;
    --json=) _rhw_files "$1" ;;
    --csv=) _rhw_files "$1" ;;
    --save | --save=) _rhw_files "$1" ;;
    --frames | --frames= | --threads | --threads= | -j | --peer-threads | --peer-threads=) ;;
    *) _rhw_rest "$1" none --scene --list --size --frames --threads --isa --peer --peer-threads --json --csv --save --help ;;
    esac
}

_rhw() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
    COMPREPLY=()
    if [[ $previous == = ]]; then # bash takes --size=512 for three words
        previous=${COMP_WORDS[COMP_CWORD - 2]}=
    elif [[ $current == = ]]; then
        current= previous=$previous=
    fi
    if ((COMP_CWORD == 1)); then
        _rhw_words "$current" render thumbs compare explain view info shader bench help --help --version
        return
    fi
    case ${COMP_WORDS[1]} in
    help) _rhw_words "$current" render thumbs compare explain view info shader bench ;;
    render | thumbs | compare | explain | view | info | shader | bench) "_rhw_${COMP_WORDS[1]}" "$current" "$previous" ;;
    esac
}

complete -F _rhw rhw
