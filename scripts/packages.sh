# Installs system packages that are missing; sourced by run.sh and test.sh.
#
#   need COMMAND_OR_FILE DEBIAN FEDORA ARCH
#
# queues a package when neither the command nor the file is there; install_needed installs the queue at once, says
# which packages these are, and asks sudo only when the user is not root. On a system with none of the three package
# managers it says what is missing and goes on.

needed=()

package_manager() {
    local manager
    for manager in apt-get dnf pacman; do
        if command -v "$manager" >/dev/null 2>&1; then
            echo "$manager"
            return
        fi
    done
}

need() {
    local what=$1
    if command -v "$what" >/dev/null 2>&1 || compgen -G "$what" >/dev/null; then
        return
    fi
    case "$(package_manager)" in
        apt-get) needed+=("$2") ;;
        dnf) needed+=("$3") ;;
        pacman) needed+=("$4") ;;
        *) echo "missing: $what (package $2 on Debian); install it by hand" >&2 ;;
    esac
}

install_needed() {
    if [ ${#needed[@]} -eq 0 ]; then
        return
    fi
    echo "installing system packages: ${needed[*]}"
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        as_root=(sudo)
    fi
    case "$(package_manager)" in
        apt-get)
            "${as_root[@]}" apt-get update -qq || true
            DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${needed[@]}"
            ;;
        dnf) "${as_root[@]}" dnf install -y -q "${needed[@]}" ;;
        pacman) "${as_root[@]}" pacman -S --noconfirm --needed "${needed[@]}" ;;
    esac
}
