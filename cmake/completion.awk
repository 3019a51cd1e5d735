# Bash completion of a program, made of its own --help:
#
#   ninefold-master --help | awk -v program=ninefold-master -f completion.awk
#
# A flag's line begins with two blanks and --; its help goes on in lines that begin with more blanks.
#   --flag                 takes no value
#   --flag FILE, --flag DIR   files, folders
#   --flag a|b             these words
#   --flag NAME            the words of its help, if that is a list: "what to show: beauty (default), albedo or depth"
#   --flag N               any other value; nothing is offered

function words_of(value, help,   parts, count, i, list) {
  if (value ~ /^[a-z0-9-]+(\|[a-z0-9-]+)+$/) {
    gsub(/\|/, " ", value)
    return value
  }
  if (value != "NAME") return ""
  gsub(/\([^()]*\)/, "", help)
  sub(/;.*/, "", help)
  sub(/^.*: /, "", help)
  gsub(/ or /, ", ", help)
  count = split(help, parts, /, */)
  list = ""
  for (i = 1; i <= count; ++i) {
    gsub(/^ +| +$/, "", parts[i])
    if (count < 2 || parts[i] !~ /^[a-z][a-z0-9-]*$/) return ""
    list = list (i > 1 ? " " : "") parts[i]
  }
  return list
}

function finish(   words) {
  if (flag == "") return
  flags = flags " " flag
  if (value != "") {
    words = words_of(value, help)
    if (value == "FILE") files = files "|" flag
    else if (value == "DIR") folders = folders "|" flag
    else if (words != "") choices = choices "    " flag ")\n      COMPREPLY=($(compgen -W '" words "' -- \"$cur\"))\n      return ;;\n"
    else others = others "|" flag
  }
  flag = ""
}

/^  (-h \[ )?--[a-z]/ {
  finish()
  line = $0
  sub(/^  -h \[ --help \]/, "  --help", line)
  match(line, /--[a-z-]+/)
  flag = substr(line, RSTART, RLENGTH)
  line = substr(line, RSTART + RLENGTH)
  value = ""
  if (line ~ /^ [^ ]/) {
    sub(/^ /, "", line)
    value = line
    sub(/ .*/, "", value)
    line = substr(line, length(value) + 1)
  }
  sub(/^ +/, "", line)
  help = line
  next
}
/^    +[^ ]/ && flag != "" {
  line = $0
  sub(/^ +/, "", line)
  help = help (help == "" ? "" : " ") line
  next
}
{ finish() }

function branch(list, action) {
  if (list != "") printf "    %s)\n      %s\n      return ;;\n", substr(list, 2), action
}

END {
  finish()
  name = program
  gsub(/-/, "_", name)
  printf "# bash completion of %s, made of its --help\n_%s() {\n", program, name
  print "  local cur prev words cword split\n  _init_completion -s || return\n  case $prev in"
  branch(files, "_filedir")
  branch(folders, "_filedir -d")
  branch(others, ":")
  printf "%s", choices
  print "  esac\n  $split && return\n  if [[ $cur == -* ]]; then"
  printf "    COMPREPLY=($(compgen -W '%s' -- \"$cur\"))\n", substr(flags, 2)
  print "  else\n    _filedir\n  fi\n}"
  printf "complete -F _%s %s\n", name, program
}
