#!/bin/sh
# Stands in for the C compilers and archivers of other systems where nothing is linked: makes the file they would make, empty.
previous=
for argument; do
    case $argument in
        -out:*) : >"${argument#-out:}" ;;
        -Fo*) : >"${argument#-Fo}" ;;
        -*) ;;
        *.a) : >"$argument" ;;
        *) [ "$previous" != -o ] || : >"$argument" ;;
    esac
    previous=$argument
done
