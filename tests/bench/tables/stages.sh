# What tests/bench/report and tests/bench/scale share. Needs `root` and `out`.

find_models() {  # exports SPLATRAY_DATA_DIR where there are models
  if [ -z "${SPLATRAY_DATA_DIR:-}" ] && [ -d "$root/../shared/data" ]; then
    SPLATRAY_DATA_DIR=$(cd "$root/../shared/data" && pwd)
  fi
  if [ -n "${SPLATRAY_DATA_DIR:-}" ]; then
    export SPLATRAY_DATA_DIR
  else
    echo "No folder of real models (SPLATRAY_DATA_DIR): the cases that need one are left out."
  fi
}

stage() {  # stage TITLE COMMAND...: runs the command and prints how long it took
  local title=$1 begin=$SECONDS
  shift
  printf '\n== %s\n' "$title"
  "$@"
  printf '== %s: %d s\n' "$title" $((SECONDS - begin))
}

require_clean() {  # what is committed must name a commit: ends when files differ from it, those of the results apart
  case "$(realpath -m "$out")" in "$root"/tests/bench/results*) ;; *) return ;; esac
  if [ -n "$(git -C "$root" status --porcelain --untracked-files=no -- . ':!tests/bench/results')" ]; then
    echo "$(basename "$0"): error: found files that differ from the commit, expected none for results that are kept" >&2
    exit 1
  fi
}
