#compdef frond
# Completion of frond(1) for zsh.
local -a verbs reading making only
verbs=(
    'build:grow what a document says and write it as a model'
    'render:make a picture of it'
    'check:say what is wrong; nothing if nothing is'
    'info:say what is in a document or a model'
    'presets:list the species that come with the program'
    'new:begin a document from a preset'
    'derive:derive an L-system and print its string'
    'convert:write a document in another format, or back'
    'vary:make a collection of instances of a plant'
    'schema:print the XML Schema of documents'
    'reference:print the reference of elements and attributes'
)
reading=(
    '*--set[change an attribute]:PATH=VALUE: '
    '--seed[seed of all plants]:seed: '
    '*--limit[allow more or less]:NAME=VALUE: '
    '--threads[threads to use]:threads: '
    '--diag[form of messages]:form:(text json)'
    '(-q --quiet)'{-q,--quiet}'[errors only]'
    '(-h --help)'{-h,--help}'[say more]'
    '*:file:_files'
)
making=(
    '*'{-o,--output}'[file to write]:file:_files'
    '--lod[level of detail]:level:(0 1 2 3 4 5 6 7 8)'
    '--stats[write statistics]:file:_files'
)
only=(
    '*--only[show only the plants called so]:name: '
    '--in-place[they stay where they stand]'
)
if (( CURRENT == 2 )); then
    _describe verb verbs
    return
fi
local verb=$words[2]
shift words
(( CURRENT-- ))
case $verb in
    build) _arguments $making $reading $only '--leaves[how leaves are written]:mode:(merged nodes gpu)' ;;
    render) _arguments $making $reading $only '--size[of the picture]:WIDTHxHEIGHT: ' \
        '--samples[paths per pixel]:samples: ' '--camera[view]:name: ' ;;
    vary) _arguments $making $reading '--count[instances]:count: ' '--plant[of the document]:id: ' \
        '--size[of each picture]:WIDTHxHEIGHT: ' '--samples[paths per pixel]:samples: ' ;;
    info) _arguments $reading '--json[as JSON]' ;;
    presets) _arguments '--json[as JSON]' ;;
    new) _arguments '--preset[species to begin with]:species:($(frond presets 2>/dev/null | cut -d" " -f1))' '1:name: ' ;;
    *) _arguments $reading ;;
esac
