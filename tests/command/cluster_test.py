# SPDX-License-Identifier: BSD-3-Clause
"""share/cluster: GNU Parallel and a Slurm of this one machine give the same tables as `vmcl evaluate` alone."""
import os
import shutil
import socket
import subprocess
import time
import unittest

from command import BIN, DONE, SAMPLE, SOURCE, CommandTest, main

SCRIPTS = SOURCE / 'share/cluster'
EXPERIMENT = f'''
rawlogs: [{{rawlog: {SAMPLE}/start.rawlog, maps: [{SAMPLE}/map.simplemap],
           ground_truth: {SAMPLE}/start.groundtruth.tum}}]
sensors: [laser]
configurations:
  - {{ini: {SOURCE}/share/config/laser.ini, changes: {{LocalizationExperiment: {{particles_count: 2000}}}}}}
starts: [given, global]
seeds: 1
'''
SLURM = '''
ClusterName=vmcl-test
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
ReturnToService=2
MpiDefault=none
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
'''


def free_ports(count):
    sockets = [socket.create_server(('127.0.0.1', 0)) for _ in range(count)]
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


class ClusterTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write('experiment.yaml', EXPERIMENT)
        self.succeed('evaluate', 'experiment.yaml', '-o', 'alone')

    def run_script(self, script, *options, **environment):
        result = subprocess.run([SCRIPTS / script, 'experiment.yaml', 'out', *options], cwd=self.folder, text=True,
                                capture_output=True, timeout=120, check=False,
                                env={**os.environ, 'VMCL': str(BIN / 'vmcl'), **environment})
        self.assertEqual((result.returncode, result.stderr), (DONE, ''))
        self.assertIn('2 of 2 runs done', result.stdout)
        for name in ('results.csv', 'results.md', 'runs.csv'):
            self.assertEqual(self.path(f'out/{name}').read_bytes(), self.path(f'alone/{name}').read_bytes(), name)

    @unittest.skipUnless(shutil.which('parallel'), 'GNU Parallel is not installed')
    def test_parallel(self):
        self.run_script('parallel.sh', '--will-cite', '--jobs', '2')

    def start_slurm(self):
        """Daemons of this test alone; they end with it. Returns the path of their configuration."""
        config = self.write('slurm.conf', SLURM.format(host=socket.gethostname().split('.')[0], folder=self.folder,
                                                       ports=free_ports(2), cpus=os.cpu_count()))
        self.write('munge.key', os.urandom(1024)).chmod(0o600)
        self.path('state').mkdir()
        self.path('spool').mkdir()
        environment = {**os.environ, 'SLURM_CONF': str(config)}
        munge_files = [f'--{what}-file={self.path("munge." + what)}' for what in ('key', 'pid', 'seed')]
        for daemon in (['munged', '--foreground', '--force', f'--socket={self.path("munge.socket")}', *munge_files],
                       ['slurmctld', '-D'], ['slurmd', '-D']):
            process = subprocess.Popen(daemon, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.addCleanup(process.wait)
            self.addCleanup(process.terminate)
            time.sleep(0.5)
        for _ in range(100):
            state = subprocess.run(['sinfo', '-h', '-o', '%t'], env=environment, capture_output=True, text=True,
                                   check=False)
            if state.stdout.strip() == 'idle':
                return config
            time.sleep(0.2)
        self.skipTest(f'no Slurm starts here: {state.stdout} {state.stderr}')

    @unittest.skipUnless(shutil.which('slurmctld') and shutil.which('slurmd') and os.geteuid() == 0,
                         'Slurm is not installed, or the test is not run by root')
    def test_slurm(self):
        self.run_script('slurm.sh', SLURM_CONF=str(self.start_slurm()))


if __name__ == '__main__':
    main()
