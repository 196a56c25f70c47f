import contextlib
import dataclasses
import getpass
import importlib.metadata
import json
import os
import platform
import re
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest
from patience import wait_for
from tables import each_row
from worker_functions import Dying, Fatal, OutOfTime, cubes, greedy

from controller.cli import main
from controller.device.bank.file_format import creator
from controller.device.kernel.crc import sealed
from controller.errors import UsageError, WorkersError
from controller.workshop.workers import dask_client as module
from controller.workshop.workers.dask_client import dask_errors
from controller.workshop.workers.map_kept import Group, map_kept
from controller.workshop.workers.workers import Workers

ITEMS = {10 * number: number for number in range(12)}
RESULTS = dict(zip(ITEMS, cubes(ITEMS.values()), strict=True))


def test_results_come_by_number_and_nothing_is_computed_twice(tmp_path):
    calls = []

    def counted(items):
        calls.append(items)
        return cubes(items)

    some = dict(list(ITEMS.items())[:5])
    first = map_kept(counted, some, tmp_path / "kept", at_once=2)
    assert first.results == {number: RESULTS[number] for number in some}
    assert (first.kept, [len(items) for items in calls]) == (0, [2, 2, 1])
    calls.clear()
    second = map_kept(counted, ITEMS, tmp_path / "kept", at_once=100)
    assert second.results == RESULTS
    assert (second.kept, calls) == (5, [(5, 6), (7, 8), (9, 10), (11,)])  # four tasks a worker
    (share,) = second.shares.values()
    assert share.items == 7
    assert 20 < share.peak_mb < 10_000
    assert second.figures()["kept"] == 5


@each_row("damage", [
    lambda data: data[:-1],
    lambda data: data + b"\0" * 12,
    lambda data: data + b"\xff" * 40,
    lambda data: data[:-9] + bytes([data[-9] ^ 1]) + data[-8:],
])  # fmt: skip
def test_what_a_power_cut_has_torn_is_computed_again(damage, tmp_path):
    kept = tmp_path / "kept"
    map_kept(cubes, ITEMS, kept)
    whole = kept.read_bytes()
    kept.write_bytes(damage(whole))
    again = map_kept(cubes, ITEMS, kept)
    assert again.results == RESULTS
    assert again.kept in (11, 12)
    assert kept.read_bytes() == whole


def test_an_interrupted_call_goes_on_where_it_was(tmp_path):
    def interrupted(items):
        if 6 in items:
            raise KeyboardInterrupt
        return cubes(items)

    with pytest.raises(KeyboardInterrupt):
        map_kept(interrupted, ITEMS, tmp_path / "kept")
    assert map_kept(cubes, ITEMS, tmp_path / "kept").kept == 6


def test_two_commands_with_one_file_do_not_meet(tmp_path):
    def inner(items):
        map_kept(cubes, ITEMS, tmp_path / "kept")

    with pytest.raises(UsageError, match="another command"):
        map_kept(inner, ITEMS, tmp_path / "kept")


def test_a_file_that_cannot_be_written_is_named(tmp_path):
    with pytest.raises(WorkersError, match=r"none/kept: cannot be written \(No such file"):
        map_kept(cubes, ITEMS, tmp_path / "none" / "kept")


def test_a_worker_of_another_version_is_refused():
    with pytest.raises(WorkersError, match="another version"):
        Group({7: 1}, creator() + "x").compute(cubes)


def changed(answer, **other):
    return dataclasses.replace(answer, **other)


@each_row("garbage", [
    lambda _: None,
    lambda _: "garbage",
    lambda answer: answer.records,
    lambda answer: changed(answer, records=answer.records[:1]),
    lambda answer: changed(answer, records=answer.records[::-1]),
    lambda answer: changed(answer, records=[*answer.records[:1], None]),
    lambda answer: changed(answer, records=[*answer.records[:1], b""]),
    lambda answer: changed(answer, records=[*answer.records[:1], answer.records[1][:-1] + b"x"]),
    lambda answer: changed(answer, records=[*answer.records[:1], sealed(bytes(12) + b"x")]),
    lambda answer: changed(answer, records=Group({7: 1, 9: 2}, creator()).compute(cubes).records),
])  # fmt: skip
def test_garbage_is_no_answer(garbage):
    group = Group({7: 1, 8: 2}, creator())
    assert group.is_answered(group.compute(cubes))
    assert not group.is_answered(garbage(group.compute(cubes)))


@each_row("error", [TypeError("identity() got an unexpected\nkeyword"), RuntimeError(""), OSError("closed")])
def test_whatever_dask_raises_is_one_line(error):
    with pytest.raises(WorkersError, match="--workers 2: dask failed") as caught, dask_errors("--workers 2"):
        raise error
    assert "\n" not in str(caught.value)


def test_errors_of_ours_and_want_of_dask_itself_stay_what_they_are():
    for error in (WorkersError("a worker has another version"), ModuleNotFoundError("no dask", name="dask")):
        with pytest.raises(type(error)) as caught, dask_errors("--workers 2"):
            raise error
        assert caught.value is error


@each_row("text", [None, "", "[]", "{}", '{"address": "tcp://127.0.0.1:1"}'])
def test_a_scheduler_file_that_leads_nowhere_is_one_line(text, tmp_path, monkeypatch):
    monkeypatch.setattr(module, "FOUND_WITHIN_S", 0.05)
    file = tmp_path / "scheduler.json"
    if text is not None:
        file.write_text(text)
    with pytest.raises(WorkersError, match=rf"--scheduler-file {file}: (not the file|no dask scheduler)") as caught:
        map_kept(cubes, ITEMS, tmp_path / "kept", Workers(scheduler_file=file))
    assert "\n" not in str(caught.value)


@each_row("arguments, said", [
    (["--workers", "0"], "--workers 0: not from 1 to 256"),
    (["--workers", "100000"], "--workers 100000: not from 1 to 256"),
    (["--workers", "2", "--dask", "tcp://h:1"], "--workers and --dask: give one"),
    (["--dask", "tcp://h:1", "--scheduler-file", "f"], "--dask and --scheduler-file: give one"),
    (["--worker-memory-mb", "20"], "not from 200 to 1e+06"),
    (["--worker-memory-mb", "2000", "--dask", "tcp://h:1"], "dask worker --memory-limit"),
])  # fmt: skip
def test_options_that_contradict_each_other_are_refused(arguments, said, capsys):
    assert main(["bank", "build", "--optimise", "quiet", *arguments]) == 2
    assert said in capsys.readouterr().err


TESTS = Path(__file__).parents[2]
PAGE = Path(module.__file__).with_name("README.md").read_text()
LOCAL, SSH, SLURM, _ = re.findall(r"^```python\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)


@pytest.fixture
def cluster(tmp_path):
    """Starts a scheduler of the page with two workers, in a process that is prepared by some code; its address."""
    with contextlib.ExitStack() as stack:

        def start(first="", *changes, environment=(), script=LOCAL):
            for old, new in changes:
                assert old in script
                script = script.replace(old, new)
            (tmp_path / "cluster.py").write_text(f"import sys\n{first}\n{script}")
            process = subprocess.Popen(
                [sys.executable, str(tmp_path / "cluster.py")],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                env=os.environ | {"PYTHONPATH": str(TESTS)} | dict(environment), start_new_session=True, cwd=tmp_path,
            )  # fmt: skip
            stack.enter_context(process)  # its standard input is closed, and it ends
            return process.stdout.readline().strip()

        yield start


@pytest.mark.slow
def test_the_cluster_of_the_page_gives_the_same_results_when_a_worker_is_killed(cluster, tmp_path):
    found = map_kept(Fatal(str(tmp_path / "killed"), 4), ITEMS, tmp_path / "kept", Workers(address=cluster()))
    assert (tmp_path / "killed").exists()
    assert found.results == RESULTS


@pytest.mark.slow
def test_a_worker_may_die_at_each_step(cluster, tmp_path):
    workers = Workers(address=cluster())
    for step in ("gets", "begins", "ends"):
        mark = tmp_path / step
        assert map_kept(Dying(str(mark), step), ITEMS, tmp_path / f"kept {step}", workers).results == RESULTS
        assert mark.exists()


@pytest.mark.slow
def test_a_scheduler_that_goes_away_is_one_line_and_what_was_done_is_kept(cluster, tmp_path):
    kept = tmp_path / "kept"
    with pytest.raises(WorkersError, match=f"--dask .*; {module.KEPT}") as caught:
        map_kept(Fatal(str(tmp_path / "killed"), 9, kept), ITEMS, kept, Workers(address=cluster()))
    assert "\n" not in str(caught.value)
    again = map_kept(cubes, ITEMS, kept)
    assert again.results == RESULTS
    assert again.kept > 0


@pytest.mark.slow
def test_workers_without_the_package_are_reported(cluster, tmp_path):
    address = cluster("sys.modules['controller'] = None", ("n_workers=2", 'n_workers=1, processes=False, protocol="tcp://"'))
    with pytest.raises(WorkersError, match=f"--dask {address}: .*lack this package.*what was done is kept") as caught:
        map_kept(cubes, ITEMS, tmp_path / "kept", Workers(address=address))
    assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_a_worker_that_answers_garbage_is_named_and_nothing_of_it_is_kept(cluster, tmp_path):
    address = cluster(
        "from controller.workshop.workers.map_kept import Group\nGroup.compute = lambda *_, **__: 'garbage'",
        ("n_workers=2", 'n_workers=1, processes=False, protocol="tcp://"'),
    )
    with pytest.raises(WorkersError, match=rf"--dask {address}: the worker tcp://[\d.:]+ answered what is no result: end it; what"):
        map_kept(cubes, ITEMS, tmp_path / "kept", Workers(address=address))
    assert map_kept(cubes, ITEMS, tmp_path / "kept").kept == 0


@pytest.mark.slow
def test_a_scheduler_without_workers_is_waited_for_and_a_line_says_so(cluster, tmp_path, monkeypatch):
    """Until the first comes, as those of job systems do."""
    address, begun = cluster("", ("n_workers=2", "n_workers=0")), []

    def begin(line):
        assert line == f"--dask {address}: the scheduler has no workers yet; they are waited for"
        command = [sys.executable, "-m", "dask", "worker", address, "--no-nanny", "--no-dashboard"]
        begun.append(subprocess.Popen(command, stderr=subprocess.DEVNULL, env=os.environ | {"PYTHONPATH": str(TESTS)}))

    monkeypatch.setattr(module, "tell", begin)
    assert map_kept(cubes, ITEMS, tmp_path / "kept", Workers(address=address)).results == RESULTS
    (worker,) = begun
    worker.terminate()
    worker.wait()


@pytest.mark.slow
def test_a_scheduler_of_another_version_is_reported_with_both(cluster, tmp_path):
    address = cluster(
        "import importlib.metadata as reported\nversion = reported.version\n"
        "reported.version = lambda name: '2024.8.0' if name == 'distributed' else version(name)"
    )
    here = re.escape(importlib.metadata.version("distributed"))
    both = rf"scheduler has distributed 2024\.8\.0, this computer distributed {here}: install"
    with pytest.raises(WorkersError, match=both):
        map_kept(cubes, ITEMS, tmp_path / "kept", Workers(address=address))


@pytest.mark.slow
def test_results_are_the_same_by_two_processes_of_which_one_is_killed(tmp_path):
    found = map_kept(Fatal(str(tmp_path / "killed"), 4), ITEMS, tmp_path / "kept", Workers(2))
    assert (tmp_path / "killed").exists()
    assert found.results == RESULTS
    assert sum(share.items for share in found.shares.values()) == len(ITEMS)


KILLED = """
import sys
from pathlib import Path
from worker_functions import Fatal
from controller.workshop.workers.map_kept import map_kept
from controller.workshop.workers.workers import Workers
if __name__ == "__main__":
    kept = Path(sys.argv[1])
    map_kept(Fatal(sys.argv[2], 9, kept), {10 * n: n for n in range(12)}, kept, Workers(2))
"""


@pytest.mark.slow
def test_after_kill_9_of_everything_the_same_call_goes_on(tmp_path):
    """The process that asks, the scheduler in it and both workers end at once, with the tenth item."""
    script = tmp_path / "killed.py"
    script.write_text(KILLED)
    ended = subprocess.run(
        [sys.executable, str(script), str(tmp_path / "kept"), str(tmp_path / "mark")],
        env=os.environ | {"PYTHONPATH": str(TESTS)}, start_new_session=True, check=False,
    )  # fmt: skip
    assert ended.returncode == -9
    for number in (1, 2):
        kept = tmp_path / f"kept{number}"
        kept.write_bytes((tmp_path / "kept").read_bytes())
        again = map_kept(cubes, ITEMS, kept, Workers(number))
        assert again.results == RESULTS
        assert 0 < again.kept < len(ITEMS)


INTERRUPTED = """
import sys
from pathlib import Path
from worker_functions import endless
from controller.workshop.workers.map_kept import map_kept
from controller.workshop.workers.workers import Workers
if __name__ == "__main__":
    try:
        map_kept(endless, {10 * n: n for n in range(12)}, Path(sys.argv[1]), Workers(2))
    except KeyboardInterrupt:
        sys.exit(130)
"""


@pytest.mark.slow
def test_ctrl_c_at_a_terminal_which_all_processes_of_it_get_is_not_answered_by_workers(tmp_path):
    script, kept = tmp_path / "interrupted.py", tmp_path / "kept"
    script.write_text(INTERRUPTED)
    interrupted = subprocess.Popen(
        [sys.executable, str(script), str(kept)],
        env=os.environ | {"PYTHONPATH": str(TESTS)}, start_new_session=True, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert wait_for("what is done", lambda: kept.exists() and kept.stat().st_size > 0, seconds=100)
    os.killpg(interrupted.pid, signal.SIGINT)
    assert interrupted.communicate()[1] == ""
    assert interrupted.returncode == 130


@pytest.mark.slow
def test_a_worker_that_takes_too_much_memory_is_ended_and_said_so(tmp_path, monkeypatch):
    monkeypatch.setitem(module.OWN_CLIENT, "distributed.scheduler.allowed-failures", 0)
    with pytest.raises(WorkersError, match=r"--workers 2: a task has lost its worker 1 times, .*more memory"):
        map_kept(greedy, {1: 1}, tmp_path / "kept", Workers(2, memory_mb=400))


@pytest.fixture
def tls(tmp_path):
    """Dask's settings of a scheduler, its workers and its clients with TLS, as the page shows them; in a folder of their own."""
    from distributed import Security

    security, folder = Security.temporary(), tmp_path / "dask"
    folder.mkdir()
    for key in ("tls_ca_file", "tls_client_cert", "tls_client_key"):
        (folder / key).write_text(getattr(security, key))
    own = {"cert": str(folder / "tls_client_cert"), "key": str(folder / "tls_client_key")}
    settings = {"ca-file": str(folder / "tls_ca_file"), "scheduler": own, "worker": own, "client": own}
    (folder / "dask.yaml").write_text(json.dumps({"distributed": {"comm": {"tls": settings}}}))
    return folder, {"distributed.comm.tls.ca-file": settings["ca-file"], "distributed.comm.tls.client": own}


@pytest.mark.slow
def test_a_scheduler_with_tls_is_reached_by_dask_own_configuration(cluster, tls, tmp_path):
    import dask

    folder, client = tls
    address = cluster(
        "from distributed import Security",
        ("LocalCluster(", 'LocalCluster(security=Security(), protocol="tls://", '),
        environment={"DASK_CONFIG": str(folder)}.items(),
    )
    assert address.startswith("tls://")
    with pytest.raises(WorkersError, match="no dask scheduler answers"):
        map_kept(cubes, ITEMS, tmp_path / "kept", Workers(address=address))
    file = tmp_path / "scheduler.json"
    file.write_text(json.dumps({"address": address}))
    with dask.config.set(client):
        found = map_kept(Fatal(str(tmp_path / "killed"), 4), ITEMS, tmp_path / "kept", Workers(scheduler_file=file))
    assert (tmp_path / "killed").exists()
    assert found.results == RESULTS


@pytest.fixture
def sshd(tmp_path):
    """OpenSSH's server on this computer, for one key: what its clients need to connect."""
    subprocess.run([TESTS / "kernel" / "install_packages.sh", "openssh-server", "openssh-client"], check=True)
    for key in ("host", "client"):
        subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", tmp_path / key], check=True)
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    settings = f"""
        ListenAddress 127.0.0.1:{port}
        HostKey {tmp_path}/host
        AuthorizedKeysFile {tmp_path}/client.pub
        StrictModes no
        UsePAM no
        PidFile none
        SetEnv PYTHONPATH={TESTS}
    """
    (tmp_path / "sshd_config").write_text(settings)
    if os.geteuid() == 0:
        Path("/run/sshd").mkdir(exist_ok=True)
    command = ["/usr/sbin/sshd", "-D", "-e", "-f", tmp_path / "sshd_config"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as server:
        assert any("Server listening" in line for line in server.stderr)
        yield {"port": port, "client_keys": str(tmp_path / "client"), "known_hosts": None}
        server.terminate()


@pytest.mark.slow
def test_the_cluster_over_ssh_gives_the_same_results_with_tls_when_a_worker_is_killed(cluster, sshd, tls, tmp_path):
    import dask

    folder, client = tls
    address = cluster(
        "",
        ('"this-computer", "worker-a", "worker-b"', '"127.0.0.1", "127.0.0.1", "127.0.0.1"'),
        ('"n_workers": 8, ', ""),
        ("SSHCluster(hosts, ", f"SSHCluster(hosts, connect_options={sshd}, scheduler_options={{'protocol': 'tls://'}}, "),
        environment={"DASK_CONFIG": str(folder)}.items(),
        script=SSH,
    )
    assert address.startswith("tls://")
    with dask.config.set(client):
        found = map_kept(Fatal(str(tmp_path / "killed"), 4), ITEMS, tmp_path / "kept", Workers(address=address))
    assert (tmp_path / "killed").exists()
    assert found.results == RESULTS
    assert sum(share.items for share in found.shares.values()) == len(ITEMS)


@pytest.fixture
def slurm(tmp_path, monkeypatch):
    """SLURM of this computer alone, without authentication: its settings are in the environment."""
    subprocess.run([TESTS / "kernel" / "install_packages.sh", "slurmctld", "slurmd", "slurm-client"], check=True)
    with socket.create_server(("127.0.0.1", 0)) as one, socket.create_server(("127.0.0.1", 0)) as other:
        ports = [server.getsockname()[1] for server in (one, other)]
    node, user = platform.node(), getpass.getuser()
    settings = f"""
        ClusterName=one
        SlurmctldHost={node}(127.0.0.1)
        SlurmctldPort={ports[0]}
        SlurmdPort={ports[1]}
        SlurmUser={user}
        SlurmdUser={user}
        AuthType=auth/none
        CredType=cred/none
        ProctrackType=proctrack/linuxproc
        TaskPlugin=task/none
        MpiDefault=none
        StateSaveLocation={tmp_path}
        SlurmdSpoolDir={tmp_path}
        SlurmctldPidFile={tmp_path}/slurmctld.pid
        SlurmdPidFile={tmp_path}/slurmd.pid
        SlurmdParameters=config_overrides
        NodeName={node} NodeAddr=127.0.0.1 CPUs=2 RealMemory=4000
        PartitionName=normal Nodes={node} MaxTime=INFINITE
    """
    file = tmp_path / "slurm.conf"
    file.write_text(settings.replace("        ", ""))
    monkeypatch.setenv("SLURM_CONF", str(file))
    with contextlib.ExitStack() as stack:
        for program in ("slurmctld", "slurmd"):
            daemon = stack.enter_context(subprocess.Popen([f"/usr/sbin/{program}", "-D"], stderr=subprocess.DEVNULL))
            stack.callback(daemon.terminate)
        state = ["sinfo", "--noheader", "--format=%t"]
        assert wait_for("SLURM", lambda: subprocess.run(state, capture_output=True, check=False).stdout == b"idle\n", seconds=60)
        yield


@pytest.mark.slow
def test_a_job_of_slurm_that_ends_at_its_time_is_replaced_and_the_next_one_goes_on(slurm, cluster, tmp_path):
    address = cluster(
        "",
        ('cores=8, processes=8, memory="8GB"', 'cores=1, processes=1, memory="1GB"'),
        ("minimum_jobs=10, maximum_jobs=10", "minimum_jobs=1, maximum_jobs=1"),
        environment={"DASK_CONFIG": str(tmp_path / "dask")}.items(),
        script=SLURM,
    )
    found = map_kept(OutOfTime(str(tmp_path / "ended"), 4), ITEMS, tmp_path / "kept", Workers(address=address))
    assert (tmp_path / "ended").exists()
    assert found.results == RESULTS
    assert len(found.shares) == 2
