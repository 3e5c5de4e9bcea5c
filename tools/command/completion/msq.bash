# Completion of msq for bash, made by msq --completion bash; tests compare.
_msq() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} options=
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W 'slice mesh render model info stats query struts calibrate --help --version --man --completion' -- "$word")
    return
  fi
  case $before in
    --completion) mapfile -t COMPREPLY < <(compgen -W 'bash zsh' -- "$word"); return ;;
    -o | --output) compopt -o default 2>/dev/null; return ;;
    --format) mapfile -t COMPREPLY < <(compgen -W 'png svg' -- "$word"); return ;;
    -p | --pitch) return ;;
    -l | --layer-height) return ;;
    --layers) return ;;
    -g | --grey) return ;;
    --mirror) mapfile -t COMPREPLY < <(compgen -W 'none x y xy' -- "$word"); return ;;
    --tolerance) return ;;
    --panel) return ;;
    --panel-size) return ;;
    --exposure) return ;;
    --first-exposure) return ;;
    --fade) return ;;
    --material) return ;;
    --unit) return ;;
    --up) mapfile -t COMPREPLY < <(compgen -W 'x -x y -y z -z' -- "$word"); return ;;
    --foam) return ;;
    --lattice) mapfile -t COMPREPLY < <(compgen -W 'cubic bcc octet fcc kelvin diamond dodecahedron reentrant' -- "$word"); return ;;
    --function) mapfile -t COMPREPLY < <(compgen -W 'gyroid schwarz-p diamond i-wp neovius f-rd lidinoid split-p fischer-koch-s c-y c-plus-minus-y karcher-k g-prime double-gyroid double-diamond double-p honeycomb rods' -- "$word"); return ;;
    --expression) return ;;
    --waves) return ;;
    --cell) return ;;
    -r | --radius) return ;;
    --radius-top) return ;;
    --thickness) return ;;
    --level) return ;;
    --volume-fraction) return ;;
    --count) return ;;
    --cones) return ;;
    --density) return ;;
    --jitter) return ;;
    --seed) return ;;
    --vent) return ;;
    --stretch) return ;;
    --weight) return ;;
    --skin) return ;;
    --box) return ;;
    --length-scale) return ;;
    -t | --threads) return ;;
    --memory) return ;;
    -s | --size) return ;;
    --view) return ;;
    --zoom) return ;;
    --at) return ;;
    --perspective) return ;;
    --samples) return ;;
    --title) return ;;
    --sample-seed) return ;;
    --phase) mapfile -t COMPREPLY < <(compgen -W 'solid void' -- "$word"); return ;;
    --two-point) return ;;
    --lineal-path) return ;;
    --direction) return ;;
    --surface) return ;;
    -w | --what) return ;;
    --channels) return ;;
    --scale) return ;;
    --region) return ;;
    -f | --fraction) return ;;
    --curve) return ;;
  esac
  case ${COMP_WORDS[1]} in
    slice) options='--output --format --pitch --layer-height --layers --grey --mirror --tolerance --panel --panel-size --landscape --exposure --first-exposure --fade --material --no-thumbnails --unit --up --any-files --foam --lattice --function --expression --waves --cell --radius --radius-top --thickness --level --sheet --volume-fraction --count --cones --density --jitter --seed --vent --stretch --weight --skin --box --length-scale --threads --memory --quiet --help' ;;
    mesh) options='--output --pitch --unit --up --any-files --foam --lattice --function --expression --waves --cell --radius --radius-top --thickness --level --sheet --volume-fraction --count --cones --density --jitter --seed --vent --stretch --weight --skin --box --length-scale --threads --memory --quiet --help' ;;
    render) options='--output --size --view --zoom --at --perspective --samples --glass --plain --unit --up --any-files --foam --lattice --function --expression --waves --cell --radius --radius-top --thickness --level --sheet --volume-fraction --count --cones --density --jitter --seed --vent --stretch --weight --skin --threads --memory --quiet --help' ;;
    model) options='--output --title --unit --up --any-files --foam --lattice --function --expression --waves --cell --radius --radius-top --thickness --level --sheet --volume-fraction --count --cones --density --jitter --seed --vent --stretch --weight --skin --threads --memory --quiet --help' ;;
    info) options='--self-intersections --json --output --unit --up --any-files --foam --lattice --function --expression --waves --cell --radius --radius-top --thickness --level --sheet --volume-fraction --count --cones --density --jitter --seed --vent --stretch --weight --skin --threads --memory --quiet --help' ;;
    stats) options='--samples --sample-seed --phase --two-point --lineal-path --direction --surface --json --output --unit --up --any-files --foam --lattice --function --expression --waves --cell --radius --radius-top --thickness --level --sheet --volume-fraction --count --cones --density --jitter --seed --vent --stretch --weight --skin --box --length-scale --threads --memory --quiet --help' ;;
    query) options='--output --what --channels --unit --up --any-files --foam --lattice --function --expression --waves --cell --radius --radius-top --thickness --level --sheet --volume-fraction --count --cones --density --jitter --seed --vent --stretch --weight --skin --length-scale --threads --memory --quiet --help' ;;
    struts) options='--output --whole --unit --up --any-files --foam --lattice --function --expression --waves --cell --radius --radius-top --thickness --level --sheet --volume-fraction --count --cones --density --jitter --seed --vent --stretch --weight --skin --scale --region --box --threads --memory --quiet --help' ;;
    calibrate) options='--fraction --curve --json --output --foam --lattice --function --expression --waves --cell --radius --radius-top --thickness --level --sheet --volume-fraction --count --cones --density --jitter --seed --vent --stretch --weight --skin --scale --region --any-files --threads --memory --quiet --help' ;;
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  else
    compopt -o default 2>/dev/null
  fi
}
complete -F _msq msq
