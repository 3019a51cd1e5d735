"""Real clients on other machines, by ssh."""
import shlex


class Hosts:
    """A line of the file for each: HOST [PROGRAM]. The cluster key goes there by ssh and is removed again."""

    def __init__(self, file, address, key):
        with open(file, encoding="utf-8") as lines:
            entries = [line.split() for line in lines if line.strip() and not line.startswith("#")]
        self.hosts = [(words[0], words[1] if len(words) > 1 else "ninefold-client") for words in entries]
        self.address, self.key = address, key

    def __len__(self):
        return len(self.hosts)

    def clients(self, count):
        def commands(_):
            for host, remote in self.hosts[:count]:
                # The key comes by standard input into a private file that goes away with the client.
                script = ("f=$(mktemp) && trap 'rm -f \"$f\"' EXIT && cat > \"$f\" && "
                          f"{shlex.quote(remote)} --master {self.address} --key-file \"$f\"")
                yield ["sh", "-c", f"ssh -o BatchMode=yes {shlex.quote(host)} {shlex.quote(script)} "
                                   f"< {shlex.quote(self.key)}"]
        return commands

    def run(self, cluster, scene, arguments, count):
        port = self.address.rpartition(":")[2]
        return cluster.run(scene, [*arguments, "--local-clients", 0, "--wait-clients", count], self.clients(count),
                           listen=f"0.0.0.0:{port}")
