"""A real Slurm of its own for tests: one machine, nothing outside one folder, no system services.

It needs Debian's packages slurmctld, slurmd, slurm-client and munge, and runs as root or as an ordinary user.
"""

import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from pathlib import Path

PROGRAMS = (
    "munged",
    "munge",
    "unmunge",
    "slurmctld",
    "slurmd",
    "sbatch",
    "squeue",
    "scancel",
    "scontrol",
    "sinfo",
)
PREFIX = "facegen-slurm-"
_SEARCH = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
_START_S = 180

_CONF = """\
ClusterName=facegen
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/log/slurmctld.log
SlurmdLogFile={folder}/log/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=1,bf_interval=1
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
ReturnToService=2
SlurmdParameters=config_overrides
KillWait=20
MinJobAge=3600
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={node_port} CPUs=2 RealMemory=4000 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=1:00:00 PriorityTier=1 PreemptMode=REQUEUE State=UP
PartitionName=urgent Nodes=ALL MaxTime=1:00:00 PriorityTier=2 PreemptMode=OFF State=UP
"""
# cred_expire is also how long a requeued job waits; the default is 120 s, and less than 5 is refused


def missing_programs() -> list[str]:
    """Programs that the sandbox needs and this machine lacks."""
    return [program for program in PROGRAMS if shutil.which(program, path=_SEARCH) is None]


class SlurmSandbox:
    """Starts on entering, and leaves no process and no file.

    Attributes
    ----------
    folder
        Short, since paths of sockets end at 107 bytes; not below pytest's, which no other user may enter.
    environ
        What commands need to reach this Slurm.
    """

    def __init__(self) -> None:
        _clear_leftovers()
        self.folder = Path(tempfile.mkdtemp(prefix=PREFIX))
        (self.folder / "owner").write_text(str(os.getpid()))
        self._daemons: list[subprocess.Popen] = []
        self.environ = os.environ | {"SLURM_CONF": str(self.folder / "slurm.conf"), "PATH": _SEARCH}

    def __enter__(self) -> "SlurmSandbox":
        try:
            self._start()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        stop(self.folder)
        for daemon in self._daemons:
            daemon.wait(timeout=60)

    def run(self, *command: str) -> str:
        """A Slurm command's output."""
        done = subprocess.run(command, env=self.environ, capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, f"{command}: {done.stderr}"
        return done.stdout

    def show(self, job: str, key: str) -> list[str]:
        """A field of all records of a job or array, from ``scontrol show job``."""
        words = self.run("scontrol", "show", "job", "-o", job).split()
        return [word.partition("=")[2] for word in words if word.startswith(f"{key}=")]

    def _start(self) -> None:
        for name in ("munge", "state", "spool", "log"):
            (self.folder / name).mkdir()
        (self.folder / "munge").chmod(0o700)
        key = self.folder / "munge" / "key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        ports = _free_ports(2)
        names = {
            "host": socket.gethostname().split(".")[0],
            "controller_port": ports[0],
            "node_port": ports[1],
        }
        user = subprocess.run(["id", "-un"], capture_output=True, text=True, check=True).stdout.strip()
        conf = self.folder / "slurm.conf"
        conf.write_text(_CONF.format(folder=self.folder, user=user, **names))
        (self.folder / "cgroup.conf").write_text("")
        munge = self.folder / "munge"
        self._daemon(
            *(
                "munged",
                "--force",
                "--foreground",
                "--num-threads=2",
                f"--key-file={key}",
                f"--socket={munge}/socket",
            ),
            *(
                f"--pid-file={munge}/pid",
                f"--seed-file={munge}/seed",
                f"--log-file={self.folder}/log/munged.log",
            ),
        )
        self._await(lambda: (munge / "socket").exists(), "munged")
        self._daemon("slurmctld", "-D", "-f", str(conf))
        self._daemon("slurmd", "-D", "-N", "n1", "-f", str(conf))
        self._await(self._is_idle, "the node")

    def _daemon(self, program: str, *arguments: str) -> None:
        with (self.folder / "log" / f"{program}.out").open("ab") as log:
            process = subprocess.Popen(
                [shutil.which(program, path=_SEARCH), *arguments],
                env=self.environ | {"FACEGEN_SANDBOX": str(self.folder)},
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                start_new_session=True,  # Ctrl-C in pytest must not hit it before its jobs
            )
        self._daemons.append(process)

    def _is_idle(self) -> bool:
        command = ["sinfo", "-h", "-N", "-o", "%T"]
        done = subprocess.run(command, env=self.environ, capture_output=True, text=True, timeout=120)
        return set(done.stdout.split()) == {"idle"}

    def _await(self, condition, what: str) -> None:
        deadline = time.monotonic() + _START_S
        while not condition():
            logs = "\n".join(
                path.read_text(errors="replace")[-500:] for path in (self.folder / "log").iterdir()
            )
            assert time.monotonic() < deadline, f"{what} did not come up within {_START_S} s:\n{logs}"
            time.sleep(0.1)


def processes(folder: Path) -> list[int]:
    """Live processes of a sandbox: daemons, steps' keepers, and jobs with all their children."""
    marks = (f"FACEGEN_SANDBOX={folder}".encode(), f"SLURM_CONF={folder}/slurm.conf".encode())
    found = []
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit() or int(entry.name) == os.getpid():
            continue
        try:
            words = (entry / "environ").read_bytes().split(b"\0")
            # slurmstepd writes its title over its environment: known by the log that it holds open
            keeper = (entry / "comm").read_text().startswith("slurm") and any(
                os.readlink(handle).startswith(f"{folder}/log/") for handle in (entry / "fd").iterdir()
            )
        except OSError:
            continue
        # a shell that merely looks at this Slurm has its configuration, but is no job
        job = marks[1] in words and any(word.startswith(b"SLURM_CLUSTER_NAME=") for word in words)
        if marks[0] in words or job or keeper:
            found.append(int(entry.name))
    return found


def stop(folder: Path) -> None:
    """End every process of a sandbox and remove its folder."""
    for number, patience_s in ((signal.SIGTERM, 3), (signal.SIGKILL, 30)):
        end = time.monotonic() + patience_s
        while (left := processes(folder)) and time.monotonic() < end:
            for process in left:
                try:
                    os.kill(process, number)
                except ProcessLookupError:
                    pass
            time.sleep(0.1)
    left = processes(folder)
    assert not left, f"processes of {folder} that do not end: {left}"
    shutil.rmtree(folder, ignore_errors=True)


def _clear_leftovers() -> None:
    """Stop sandboxes of test runs that were killed."""
    for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
        try:
            os.kill(int((folder / "owner").read_text()), 0)
        except FileNotFoundError:
            if folder.exists() and time.time() - folder.stat().st_mtime > _START_S:
                stop(folder)  # a young one is just being made by another run
        except (OSError, ValueError):
            stop(folder)


def _free_ports(count: int) -> list[int]:
    sockets = [socket.socket() for _ in range(count)]
    try:
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]
    finally:
        for one in sockets:
            one.close()
