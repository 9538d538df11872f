#!/bin/bash
# Fails on an include against the layers core <- adjoint <- estimation <- experiments and
# core <- benchmarks/baselines <- experiments, on Ceres or OpenCV below estimation, and on a baseline
# method outside of benchmarks/baselines.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

failed=0
# forbid REASON PATTERN FOLDER...: no #include in FOLDER... may match PATTERN (after the < or ").
forbid() {
  local reason=$1 pattern=$2 hits
  shift 2
  if hits=$(grep -rnE "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]($pattern)" "$@"); then
    printf '%s:\n%s\n' "$reason" "$hits"
    failed=1
  fi
}

forbid "core may include core only" "(adjoint|estimation|experiments|benchmarks|tests)/" core
forbid "adjoint may include core only" "(estimation|experiments|benchmarks|tests)/" adjoint
forbid "estimation may include adjoint and core only" "(experiments|benchmarks|tests)/" estimation
forbid "experiments may include the baselines, but not tests or other benchmarks" \
  "(benchmarks/[^b]|benchmarks/b[^a]|tests/)" experiments
forbid "baselines may include core and each other only" \
  "(adjoint|estimation|experiments|tests|benchmarks/[^b]|benchmarks/b[^a])" benchmarks/baselines
forbid "Ceres belongs to estimation and the tests" "ceres/" core adjoint experiments benchmarks
forbid "OpenCV belongs to estimation" "opencv2?/" core adjoint
forbid "includes start at the project's root" "\.\./" core adjoint estimation experiments benchmarks tests

if baselines=$(find core adjoint estimation -iname '*baseline*' | grep .); then
  printf 'baseline methods belong to benchmarks/baselines:\n%s\n' "$baselines"
  failed=1
fi
exit "$failed"
