# Completion of frond(1) for bash.
_frond() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} verb=
    [[ $COMP_CWORD -gt 1 ]] && verb=${COMP_WORDS[1]}
    local verbs='build render check info presets new derive convert vary schema reference'
    local reading='--seed --set --threads --limit --diag --quiet --verbose --help'
    local making="--output --lod --stats $reading"
    case $previous in
    --leaves) mapfile -t COMPREPLY < <(compgen -W 'merged nodes gpu' -- "$current") && return ;;
    --diag) mapfile -t COMPREPLY < <(compgen -W 'text json' -- "$current") && return ;;
    --preset)
        mapfile -t COMPREPLY < <(compgen -W "$(frond presets 2>/dev/null | cut -d' ' -f1)" -- "$current")
        return
        ;;
    esac
    case $verb in
    '') mapfile -t COMPREPLY < <(compgen -W "$verbs --help --version" -- "$current") && return ;;
    build) making+=' --leaves --steps --checkpoint --resume --only --in-place' ;;
    vary) making+=' --leaves --count --plant --size --samples' ;;
    render) making+=' --size --samples --camera --frames --steps --checkpoint --resume --only --in-place' ;;
    check) making=$reading ;;
    info) making="--json $reading" ;;
    presets) making='--json --help' ;;
    new) making='--preset --help' ;;
    *) making='--help' ;;
    esac
    if [[ $current == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$making" -- "$current")
    else
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -f -- "$current")
    fi
}
complete -F _frond frond
