#!/bin/bash
# One-node SLURM on this machine, for tests. Debian 12: apt-get install -y slurmctld slurmd slurm-client munge
# Started as root; usage: slurm-local.sh start DIR | stop DIR
set -eu
cmd=$1; dir=$(realpath -m "$2")
case $cmd in
start)
  mkdir -p "$dir"/{state,spool} /run/munge; chown munge:munge /run/munge
  cat > "$dir/slurm.conf" <<C
ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
AuthType=auth/munge
SlurmUser=root
SlurmdUser=root
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd.log
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
SlurmctldPort=16817
SlurmdPort=16818
NodeName=localhost NodeAddr=127.0.0.1 NodeHostname=$(hostname -s) CPUs=$(nproc) RealMemory=$(( $(awk '/MemTotal/{print $2}' /proc/meminfo) / 1024 - 512 )) State=UNKNOWN
PartitionName=debug Nodes=ALL Default=YES MaxTime=INFINITE State=UP
C
  cp "$dir/slurm.conf" /etc/slurm/slurm.conf   # or: export SLURM_CONF=$dir/slurm.conf for every client
  munge -n >/dev/null 2>&1 || { setpriv --reuid=munge --regid=munge --clear-groups /usr/sbin/munged; sleep 1; }
  slurmctld -f "$dir/slurm.conf"; sleep 1
  slurmd -f "$dir/slurm.conf" -N localhost
  for _ in $(seq 30); do sinfo -h -o %t | grep -q idle && break; sleep 0.5; done
  sinfo ;;
stop)
  for p in slurmd slurmctld; do [ -f "$dir/$p.pid" ] && kill "$(cat "$dir/$p.pid")" || true; done ;;
esac
