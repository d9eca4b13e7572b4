"""A Slurm of one node on this machine, for tests: slurmctld and slurmd, with a configuration, ports and
files of their own. It needs no rights of root and no service of the system.

The node pretends to have eight processors, so that eight tasks run at once. Slurm's usual waits are
shortened: a requeued task starts after 5 seconds instead of 2 minutes.
"""

import os
import pwd
import shutil
import socket
import subprocess
import time

CONFIGURATION = """
ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/none
CredType=cred/none
AuthInfo=cred_expire=5
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=2
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
NodeName=node NodeHostname={host} NodeAddr=127.0.0.1 CPUs=8 RealMemory=1000
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""
PATIENCE = 120  # seconds
SYSTEM_PATH = ":/usr/sbin"  # where the daemons are


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def wait_until(condition, what):
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise SystemExit(f"waited in vain: {what}")
        time.sleep(0.01)


class OneNodeSlurm:
    """`environment` is that of the node and of its tasks, and names `folder`; `kill_all` kills all
    processes whose environment does."""

    def __init__(self, folder, environment, kill_all):
        self.environment = {**environment, "SLURM_CONF": os.path.join(folder, "slurm.conf"),
                            "PATH": environment["PATH"] + SYSTEM_PATH}
        self.kill_all = kill_all
        self.folder = folder
        for name in ("state", "spool"):
            os.makedirs(os.path.join(folder, name))
        with open(self.environment["SLURM_CONF"], "w", encoding="utf-8") as file:
            file.write(CONFIGURATION.format(
                host=socket.gethostname().split(".")[0], user=pwd.getpwuid(os.getuid()).pw_name, folder=folder,
                controller_port=free_port(), node_port=free_port()))
        # The environment does not name the folder, so that kill_all() spares this process.
        self.controller = self.start("slurmctld", "-D", "-i", "-f", self.environment["SLURM_CONF"],
                                     environment=os.environ)
        self.node = self.start("slurmd", "-D", "-N", "node")
        self.wait_for_idle_node()

    def start(self, *command, environment=None):
        """Starts a daemon, which ends with this process, even if this process is killed."""
        name = os.path.join(self.folder, command[0] + ".out")
        with open(name, "ab") as out:
            return subprocess.Popen(
                ["setpriv", "--pdeathsig", "KILL", shutil.which(command[0], path=self.environment["PATH"]), *command[1:]],
                stdout=out, stderr=out, env=environment or self.environment, cwd=self.folder)

    def answer(self, *command):
        """What a command of Slurm prints. The command is repeated while it fails: it does so before
        the controller has started, and where the controller takes too long to answer."""
        done = None

        def succeeds():
            nonlocal done
            done = subprocess.run(command, env=self.environment, capture_output=True, text=True,
                                  check=False)
            return done.returncode == 0

        wait_until(succeeds, " ".join(command))
        return done.stdout.strip()

    def running_tasks(self):
        return self.answer("squeue", "--noheader", "--states=R", "--format=%i").split()

    def wait_for_idle_node(self):
        wait_until(lambda: self.answer("sinfo", "--noheader", "--format=%T") == "idle", "the node")

    def requeue(self, tasks):
        """Kills tasks in good order (SIGTERM), and starts them again."""
        for task in tasks:
            subprocess.run(["scontrol", "requeue", task], env=self.environment, check=True)

    def crash_node(self):
        """Kills (SIGKILL) the node's daemon and all tasks, tells the controller that the node is down,
        and starts the node again. By itself, the controller notices such a crash after SlurmdTimeout
        (5 minutes), and then does the same: it requeues all tasks of the node."""
        self.kill_all()
        self.node.wait()
        self.answer("scontrol", "update", "NodeName=node", "State=DOWN", "Reason=crash")
        self.node = self.start("slurmd", "-D", "-N", "node", "-b")  # -b: the node was restarted
        self.wait_for_idle_node()

    def stop(self):
        for daemon in (self.controller, self.node):
            daemon.terminate()
            daemon.wait()
