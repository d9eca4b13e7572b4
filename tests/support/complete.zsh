# Types a line into an interactive zsh, presses Tab, and prints what has become of the line.
#   zsh -f complete.zsh FOLDER LINE        FOLDER holds the completion, _ibmfair
zmodload zsh/zpty
zpty shell "FOLDER=${(q)1} ZDOTDIR=/nonexistent TERM=dumb zsh -f -i"
zpty -w shell 'unsetopt zle_bracketed_paste beep; PS1=; fpath=($FOLDER $fpath)'
zpty -w shell 'autoload -U compinit; compinit -u -D'
zpty -w shell 'tell() { print -r -- "<<$BUFFER>>" }; zle -N tell; bindkey "^Xt" tell'
zpty -w shell 'bindkey "^I" complete-word; stty -echo; print rea""dy'
local output= chunk
until [[ $output == *ready* ]]; do zpty -r shell chunk || exit 1; output+=$chunk; done
zpty -n -w shell "$2"$'\t\x18t'
output=
until [[ $output == *'<<'*'>>'* ]]; do zpty -r shell chunk || exit 1; output+=$chunk; done
print -r -- "${${output#*<<}%%>>*}"
zpty -d shell
