"""What scripts/test_packages does; see there."""
import argparse
import json
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from systems import CACHE, ROOT, Failure, booted, run, system  # noqa: E402  the path comes first

PAGE = dict(re.findall(r"^```sh (\S+)\n(.*?)^```$", (ROOT / "docs/cluster.md").read_text(), re.MULTILINE | re.DOTALL))
WINDOW = ["libglfw3", "libgl1", "libx11-6", "libimgui-dev", "libwayland-client0"]
PROGRAMS = {"ninefold": ["ninefold-master", "ninefold-compare", "ninefold-replay-task"],
            "ninefold-client": ["ninefold-client", "ninefold-doctor"]}
# Complaints of lintian about what is so on purpose: packages that are not Debian's own have no bug to close and no
# address, and their versions name a commit.
ALLOWED = ["initial-upload-closes-no-bugs", "no-changelog", "bogus-mail-host", "maintainer-script-calls-systemctl",
           "package-has-long-file-name"]


def check(condition, what):
    if not condition:
        raise Failure(what)


def this_release():
    return platform.freedesktop_os_release()["VERSION_CODENAME"]


def build(release, folder, files):
    if release == this_release():
        return run(ROOT / "scripts/package", folder)
    with system(release, files) as place:
        run("git", "clone", "-q", ROOT, place.path("/root/ninefold"))
        compiled = CACHE / f"{release}-ccache"
        compiled.mkdir(parents=True, exist_ok=True)
        place.run("apt-get update -qq && cd ninefold && scripts/package /root/packages", compiled)
        folder.mkdir(parents=True)
        for package in place.path("/root/packages").glob("*.deb"):
            shutil.copy(package, folder)


def put_packages(place, folder):
    for package in folder.glob("*.deb"):
        shutil.copy(package, place.path("/root"))
    place.run("apt-get update -qq")


def test_client_alone(release, folder, files):
    with system(release, files) as place:
        put_packages(place, folder)
        place.run(PAGE["install-client"])
        came = [name for name in WINDOW if place.has(name)]
        check(not came, f"the client brings {came} of the window")
        for program in PROGRAMS["ninefold-client"]:
            check(place.run(f"{program} --version").startswith(program), "--version")
        place.run("apt-get purge -y -qq ninefold-client ninefold-common")
        check(not place.run("dpkg -l 'ninefold*' 2> /dev/null | grep '^.i' || true"), "a package is left")
        left = place.run("find /usr /etc -name '*ninefold*'")
        check(not left, f"files are left: {left}")


def test_pages(place):
    """Each program has a page and completion that name all its flags, a version and its help."""
    for programs in PROGRAMS.values():
        for program in programs:
            said = place.run(f"{program} --help")
            flags = set(re.findall(r"^  (?:-h \[ )?(--[a-z-]+)", said, re.MULTILINE))
            page = place.run(f"zcat /usr/share/man/man1/{program}.1.gz").replace("\\-", "-")
            completion = place.run(f"bash -n /usr/share/bash-completion/completions/{program}; "
                                   f"cat /usr/share/bash-completion/completions/{program}")
            for flag in flags:
                check(flag in page and flag in completion, f"{program}: no {flag} in its page or completion")
    shown = place.run("""bash -c '. /usr/share/bash-completion/bash_completion
        . /usr/share/bash-completion/completions/ninefold-master
        COMP_WORDS=(ninefold-master --method bid); COMP_CWORD=2; COMP_LINE="ninefold-master --method bid"; COMP_POINT=28
        _ninefold_master; echo "${COMPREPLY[@]}"'""")
    check(shown.strip() == "bidirectional", f"completion offers {shown!r}")


def statistics(machine):
    return json.loads(machine.run("cat stats.json"))


def master(machine, block, **variables):
    """The last command of a block of the page, started; more by the environment, as the page's flags stand."""
    given = " ".join(f"NINEFOLD_{k.upper()}={v}" for k, v in variables.items())
    command = PAGE[block].strip().splitlines()[-1]
    return machine.start(f"export {given} NINEFOLD_SIZE=96x72 NINEFOLD_STATS=stats.json; exec {command}")


def finish(machine, process, hashes):
    said, _ = process.communicate(timeout=180)
    check(process.returncode == 0, f"a master ended with status {process.returncode}:\n{said}")
    stats = statistics(machine)
    hashes.add(stats["image_hash"])
    check(len(hashes) == 1, "the pictures are not the same")
    return [client["name"] for client in stats["clients"]]


def test_machine(machine):
    hashes = set()
    machine.run("echo 127.0.0.1 render-master render1 >> /etc/hosts; hostname > name")
    machine.run(PAGE["lan-master"].splitlines()[0])
    check("local1" in finish(machine, master(machine, "lan-master"), hashes), "a master alone renders")

    print("== LAN", flush=True)
    running = master(machine, "lan-master", local_clients=0)
    machine.until("grep -q ' 00000000:125C 00000000:0000 0A ' /proc/net/tcp")  # somebody listens at 4700
    doctor, client = PAGE["lan-client"].splitlines()
    print(machine.run(doctor), flush=True)
    machine.run(client)
    check(finish(machine, running, hashes) == [machine.run("cat name").strip()], "the client of the page renders")

    print("== service", flush=True)
    machine.run(PAGE["service"])
    for _ in range(2):  # there before its master, and again after it
        check(len(finish(machine, master(machine, "lan-master", local_clients=0), hashes)) == 1, "the service renders")
    machine.until("ps -o user= -p $(systemctl show -P MainPID ninefold-client@render-master:4700) | grep -x ninefold")
    print(machine.run("systemd-analyze security --no-pager ninefold-client@render-master:4700 | tail -n 1"), flush=True)
    machine.run(PAGE["rotate"])
    finish(machine, master(machine, "lan-master", local_clients=0), hashes)
    for command in PAGE["service-look"].splitlines():
        machine.run(f"{command} || [ $? = 3 ]")  # 3: between two starts
    check("inactive" in machine.run("systemctl is-active ninefold-client@render-master:4700 || true"), "the service ended")

    print("== ssh", flush=True)
    machine.run("install -d -m 700 .ssh; ssh-keygen -q -t ed25519 -N '' -f .ssh/id_ed25519; "
                "cp .ssh/id_ed25519.pub .ssh/authorized_keys; systemctl start ssh; "
                "ssh-keyscan -H render1 > .ssh/known_hosts; echo render1 > hosts")
    check(finish(machine, master(machine, "ssh", local_clients=0), hashes) == ["render1"], "ssh starts the client")


def test_all(release, folder, files):
    with system(release, files) as place:
        put_packages(place, folder)
        place.run(PAGE["install"])
        print("== pages", flush=True)
        place.install("bash-completion", "systemd", "systemd-sysv", "dbus", "openssh-server", "openssh-client", "procps",
                      "hostname")
        test_pages(place)
        place.run("systemd-sysusers && systemd-analyze verify --man=no /lib/systemd/system/ninefold-client@.service")
        with booted(place) as machine:
            test_machine(machine)
        place.run("apt-get purge -y -qq 'ninefold*'")
        check(not place.run("find /usr -name '*ninefold*'"), "files are left")


def test_lintian(folder):
    if not shutil.which("lintian"):
        return print("lintian is not installed: skipped")
    done = subprocess.run(["lintian", "--suppress-tags", ",".join(ALLOWED), *folder.glob("*.deb")], stdout=subprocess.PIPE,
                          text=True, check=False)
    print(done.stdout)
    check(not re.search("^E:", done.stdout, re.MULTILINE), "lintian finds errors")


def main():
    parser = argparse.ArgumentParser(prog="test_packages")
    parser.add_argument("release", nargs="?", choices=["bookworm", "trixie"], default=this_release())
    parser.add_argument("--packages", type=pathlib.Path)
    parser.add_argument("--files", type=pathlib.Path)
    arguments = parser.parse_args()
    if os.geteuid() != 0 or not shutil.which("debootstrap") or not shutil.which("systemd-nspawn"):
        sys.exit("test_packages: needs root, debootstrap and systemd-container")
    if arguments.files and not arguments.files.is_dir():
        sys.exit(f"test_packages: no folder {arguments.files}; give the one that --files copies from")
    folder = arguments.packages
    if folder is None:
        folder = ROOT / "out/packages-test" / arguments.release
        shutil.rmtree(folder, ignore_errors=True)
        print("== build", flush=True)
        build(arguments.release, folder, arguments.files)
    try:
        print("== lintian", flush=True)
        test_lintian(folder)
        print("== client alone", flush=True)
        test_client_alone(arguments.release, folder, arguments.files)
        test_all(arguments.release, folder, arguments.files)
    except Failure as failure:
        sys.exit(f"test_packages: {failure}")
    print(f"the packages work on {arguments.release}")


if __name__ == "__main__":
    main()
