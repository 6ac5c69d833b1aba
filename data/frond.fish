# Completion of frond(1) for fish.
function __frond_presets
    frond presets 2>/dev/null | string replace -r '^(\S+)\s+' '$1\t'
end

set -l making build render vary
set -l reading build render vary check info derive convert

complete -c frond -n __fish_use_subcommand -f -a build -d 'grow what a document says and write it as a model'
complete -c frond -n __fish_use_subcommand -f -a render -d 'make a picture of it'
complete -c frond -n __fish_use_subcommand -f -a check -d 'say what is wrong; nothing if nothing is'
complete -c frond -n __fish_use_subcommand -f -a info -d 'say what is in a document or a model'
complete -c frond -n __fish_use_subcommand -f -a presets -d 'list the species that come with the program'
complete -c frond -n __fish_use_subcommand -f -a new -d 'begin a document from a preset'
complete -c frond -n __fish_use_subcommand -f -a derive -d 'derive an L-system and print its string'
complete -c frond -n __fish_use_subcommand -f -a convert -d 'write a document in another format, or back'
complete -c frond -n __fish_use_subcommand -f -a vary -d 'make a collection of instances of a plant'
complete -c frond -n __fish_use_subcommand -f -a schema -d 'print the XML Schema of documents'
complete -c frond -n __fish_use_subcommand -f -a reference -d 'print the reference of elements and attributes'

complete -c frond -l help -s h -d 'say more of a verb'
complete -c frond -n "__fish_seen_subcommand_from $making" -l output -s o -r -d 'file to write'
complete -c frond -n "__fish_seen_subcommand_from $making" -l lod -x -a '0 1 2 3 4 5 6 7 8' -d 'level of detail'
complete -c frond -n "__fish_seen_subcommand_from build vary" -l leaves -x -a 'merged nodes gpu' -d 'how leaves are written'
complete -c frond -n "__fish_seen_subcommand_from render vary" -l size -x -d 'WIDTHxHEIGHT'
complete -c frond -n "__fish_seen_subcommand_from render vary" -l samples -x -d 'paths per pixel'
complete -c frond -n "__fish_seen_subcommand_from build render" -l only -x -d 'show only the plants called so'
complete -c frond -n "__fish_seen_subcommand_from build render" -l in-place -d 'they stay where they stand'
complete -c frond -n "__fish_seen_subcommand_from render" -l camera -x -d 'view of that name'
complete -c frond -n "__fish_seen_subcommand_from $reading" -l set -x -d 'PATH=VALUE'
complete -c frond -n "__fish_seen_subcommand_from $reading" -l seed -x -d 'seed of all plants'
complete -c frond -n "__fish_seen_subcommand_from $reading" -l limit -x -d 'NAME=VALUE'
complete -c frond -n "__fish_seen_subcommand_from $reading" -l threads -x -d 'threads to use'
complete -c frond -n "__fish_seen_subcommand_from $reading" -l diag -x -a 'text json' -d 'form of messages'
complete -c frond -n "__fish_seen_subcommand_from info presets" -l json -d 'as JSON'
complete -c frond -n "__fish_seen_subcommand_from new" -l preset -x -a '(__frond_presets)' -d 'species to begin with'
