# bash's completion of seam. The program is asked for its commands, options, methods, arms, scenes and experiments: it knows them.
_seam() {
  local program=${COMP_WORDS[0]} command=${COMP_WORDS[1]-} word=$2 previous=$3 help words=
  if ((COMP_CWORD == 1)); then
    help=$("$program" --help 2>/dev/null)
    words=$(sed -nE '1,/^Subcommands:/d; s/^  ([a-z]+) .*/\1/p' <<<"$help")
  else
    help=$("$program" "$command" --help 2>/dev/null)
  fi
  if [[ $word == -* ]]; then
    words=$(sed -nE 's/^  (-[a-zA-Z],)?(--[a-z-]+).*/\2/p' <<<"$help")
  elif [[ $previous == --method || $previous == --compare ]]; then
    words=$(sed -nE 's/^.*joining method: ([a-z0-9, ]+).*/\1/p' <<<"$("$program" run --help)")
    words=${words//,/ }
  elif [[ $previous == --arm ]]; then
    words=$(sed -nE 's/^.* arm: ([a-z, ]+)[,(].*/\1/p' <<<"$help")
    words=${words//,/ }
  elif [[ $previous != -* ]]; then
    case $command in
      bench | run | sweep) words=$("$program" bench --list 2>/dev/null | cut -d ' ' -f 1) ;;
      experiment) words=$("$program" experiment --list 2>/dev/null | cut -d ' ' -f 1) ;;
    esac
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -o bashdefault -o default -F _seam seam
