# To be sourced by a script that plays a user, called as SCRIPT FOLDER ACTION... -- ARGUMENT...: leaves `folder`, `actions`
# and the arguments, on a display of its own of size $screen.
folder=$1
shift
actions=()
while [ "$1" != -- ]; do
    actions+=("$1")
    shift
done
shift

if [ -z "${ROWLAND_INSIDE_XVFB:-}" ]; then
    # A server that begins anew when its last program has gone signals xvfb-run, whose own end then may fail.
    ROWLAND_INSIDE_XVFB=1 exec xvfb-run -a -s "-noreset -screen 0 ${screen}x24" bash "$0" "$folder" "${actions[@]}" -- "$@"
fi
