#!/bin/sh
# Certificates as golden files: checks that each model has one, that it holds, and that it comes out again.
#
#   sh certify-in-ci.sh [check]   check every certificate, solve every model again, compare the bytes
#   sh certify-in-ci.sh update    make the certificates that are missing, and those that differ anew
#
# Variables: MODELS, the folder with NAME.toml (models); CERTS, that with NAME.json (certs); CERTIFY_POSES, the command
# (certify-poses); SOLVE_OPTIONS, for certificates that update makes where there is none (such as: --method krawczyk).
#
# Exit codes: 0 all is as it was; 1 a certificate is missing, rejected or differs; 2 a file cannot be read or used;
# 4 no answer. Copy this file into your repository; it needs a POSIX shell and pkm_exact, nothing else.

set -u
models=${MODELS:-models}
certs=${CERTS:-certs}
certify=${CERTIFY_POSES:-certify-poses}
missing=0
failed=0

fail() {
    echo "certify-in-ci: $1" >&2
    exit 2
}

# Makes the certificate of a model. A claim weaker than complete (3) is an answer too.
make_certificate() {
    # shellcheck disable=SC2086 # options are words
    $certify solve ${SOLVE_OPTIONS:-} -o "$2" "$1" >/dev/null
    code=$?
    case $code in
    0 | 3) echo "$2: written" ;;
    *) failed=$code ;;
    esac
}

action=${1:-check}
case $action in
check) update= ;;
update) update=--update ;;
*) fail "$action: is unknown; use check or update" ;;
esac
command -v "${certify%% *}" >/dev/null || fail "${certify%% *}: is not installed; see CERTIFY_POSES"
set -- "$models"/*.toml
[ -e "$1" ] || fail "$models: has no *.toml in it; give MODELS the folder with the model files"
[ -z "$update" ] || mkdir -p "$certs" || exit 2

for model; do
    name=${model##*/}
    certificate=$certs/${name%.toml}.json
    [ ! -e "$certificate" ] || continue
    if [ -n "$update" ]; then
        make_certificate "$model" "$certificate"
    else
        echo "$model: no certificate $certificate; make it: sh certify-in-ci.sh update"
        missing=1
    fi
done

set -- "$certs"/*.json
if [ -e "$1" ]; then
    # shellcheck disable=SC2086 # empty, or one word
    $certify check --recompute $update --models "$models" "$certs"
    code=$?
    [ "$code" -eq 0 ] || [ "$failed" -eq 1 ] || failed=$code
fi
[ "$missing" -eq 0 ] || failed=1
exit "$failed"
